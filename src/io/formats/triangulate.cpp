#include "io/formats/triangulate.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

namespace stackabilization {

namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_2;

/// Newell's area vector with coordinates scaled to at most 1, so that it cannot overflow.
Eigen::Vector3d newell_normal(const Points& vertices, std::span<const std::int32_t> polygon) {
  double scale = 0;
  for (const std::int32_t v : polygon) scale = std::max(scale, vertices.row(v).cwiseAbs().maxCoeff());
  if (scale == 0) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d origin = vertices.row(polygon[0]).transpose() / scale;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  Eigen::Vector3d previous = vertices.row(polygon.back()).transpose() / scale - origin;
  for (const std::int32_t v : polygon) {
    const Eigen::Vector3d current = vertices.row(v).transpose() / scale - origin;
    normal += previous.cross(current);
    previous = current;
  }
  return normal;
}

/// The corners in the coordinate plane that the normal is most orthogonal to, counter-clockwise seen along
/// it.
std::vector<Point> project(const Points& vertices, std::span<const std::int32_t> polygon,
                           const Eigen::Vector3d& normal) {
  Eigen::Index dropped = 2;
  normal.cwiseAbs().maxCoeff(&dropped);
  Eigen::Index first = (dropped + 1) % 3;
  Eigen::Index second = (dropped + 2) % 3;
  if (normal[dropped] < 0) std::swap(first, second);
  std::vector<Point> points;
  points.reserve(polygon.size());
  for (const std::int32_t v : polygon) points.emplace_back(vertices(v, first), vertices(v, second));
  return points;
}

/// Strictly convex and winding once: every corner turns left and the directions of the sides cross the x axis
/// twice.
bool is_strictly_convex(const std::vector<Point>& points) {
  const std::size_t count = points.size();
  int changes_of_direction = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Point& a = points[i];
    const Point& b = points[(i + 1) % count];
    const Point& c = points[(i + 2) % count];
    if (CGAL::orientation(a, b, c) != CGAL::LEFT_TURN) return false;
    changes_of_direction += CGAL::compare_xy(a, b) != CGAL::compare_xy(b, c);
  }
  return changes_of_direction == 2;
}

class EarCutter {
 public:
  EarCutter(const std::vector<Point>& points, std::span<const std::int32_t> polygon)
      : points_(points),
        polygon_(polygon),
        next_(points.size()),
        previous_(points.size()),
        is_ear_(points.size()) {
    const int count = static_cast<int>(points.size());
    for (int i = 0; i < count; ++i) {
      next_[i] = (i + 1) % count;
      previous_[i] = (i + count - 1) % count;
    }
    for (int i = 0; i < count; ++i)
      if (turn(i) != CGAL::LEFT_TURN) blockers_.push_back(i);
    for (int i = 0; i < count; ++i) is_ear_[i] = test_ear(i);
  }

  std::vector<std::array<std::int32_t, 3>> cut() {
    int corner = 0;
    for (int left = static_cast<int>(points_.size()); left > 3; --left) {
      corner = find_ear(corner, left);
      clip(corner);
      // Going on one further makes fewer slivers than clipping around the same corner.
      corner = next_[next_[corner]];
    }
    emit(corner);
    return std::move(triangles_);
  }

 private:
  CGAL::Orientation turn(int i) const {
    return CGAL::orientation(points_[previous_[i]], points_[i], points_[next_[i]]);
  }

  /// A simple polygon has an ear; one that crosses itself may not, and then `start` has to do.
  int find_ear(int start, int left) const {
    int corner = start;
    for (int tried = 0; tried < left; ++tried, corner = next_[corner])
      if (is_ear_[corner]) return corner;
    return start;
  }

  bool test_ear(int i) const {
    if (turn(i) != CGAL::LEFT_TURN) return false;
    const Point& a = points_[previous_[i]];
    const Point& b = points_[i];
    const Point& c = points_[next_[i]];
    return std::none_of(blockers_.begin(), blockers_.end(), [&](int other) {
      const Point& p = points_[other];
      if (p == a || p == b || p == c) return false;
      return CGAL::orientation(a, b, p) != CGAL::RIGHT_TURN &&
             CGAL::orientation(b, c, p) != CGAL::RIGHT_TURN && CGAL::orientation(c, a, p) != CGAL::RIGHT_TURN;
    });
  }

  void emit(int i) { triangles_.push_back({polygon_[previous_[i]], polygon_[i], polygon_[next_[i]]}); }

  /// Only the two neighbours of a clipped ear can become ears or cease to be (O'Rourke 1998, section 1.4).
  void clip(int i) {
    emit(i);
    const int before = previous_[i];
    const int after = next_[i];
    next_[before] = after;
    previous_[after] = before;
    std::erase_if(blockers_, [&](int other) {
      return other == i || ((other == before || other == after) && turn(other) == CGAL::LEFT_TURN);
    });
    is_ear_[before] = test_ear(before);
    is_ear_[after] = test_ear(after);
  }

  const std::vector<Point>& points_;
  std::span<const std::int32_t> polygon_;
  std::vector<int> next_, previous_;
  std::vector<char> is_ear_;
  std::vector<int> blockers_;  ///< Remaining corners that do not turn left: only these can lie in an ear.
  std::vector<std::array<std::int32_t, 3>> triangles_;
};

std::vector<std::array<std::int32_t, 3>> fan(std::span<const std::int32_t> polygon) {
  std::vector<std::array<std::int32_t, 3>> triangles;
  triangles.reserve(polygon.size() - 2);
  for (std::size_t i = 2; i < polygon.size(); ++i)
    triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
  return triangles;
}

}  // namespace

std::vector<std::array<std::int32_t, 3>> triangulate(const Points& vertices,
                                                     std::span<const std::int32_t> polygon) {
  if (polygon.size() == 3) return fan(polygon);
  const std::vector<Point> points = project(vertices, polygon, newell_normal(vertices, polygon));
  if (is_strictly_convex(points)) return fan(polygon);
  return EarCutter(points, polygon).cut();
}

}  // namespace stackabilization
