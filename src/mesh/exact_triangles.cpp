#include "stackabilization/mesh/exact_triangles.h"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <utility>

namespace stackabilization {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Corners = std::array<std::int32_t, 3>;

/// Triangles with the same three corners.
struct Sheaf {
  Corners corners;
  std::vector<std::int32_t> rows;
};

using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, const Sheaf*>;

std::vector<Sheaf> sheaves_of(const Triangles& rows) {
  std::vector<std::pair<Corners, std::int32_t>> triangles;
  for (std::int32_t t = 0; t < rows.rows(); ++t) {
    Corners corners{rows(t, 0), rows(t, 1), rows(t, 2)};
    std::sort(corners.begin(), corners.end());
    triangles.emplace_back(corners, t);
  }
  std::sort(triangles.begin(), triangles.end());
  std::vector<Sheaf> sheaves;
  for (const auto& [corners, row] : triangles) {
    if (sheaves.empty() || sheaves.back().corners != corners) sheaves.push_back({corners, {}});
    sheaves.back().rows.push_back(row);
  }
  return sheaves;
}

Point point_of(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

class PairTest {
 public:
  explicit PairTest(const std::vector<Point>& points) : points_(points) {}

  bool intersect(Corners a, Corners b) const {
    const int shared = move_shared_first(a, b);
    switch (shared) {
      case 0:
        return CGAL::do_intersect(triangle(a), triangle(b));
      // Triangles with one common corner intersect elsewhere only when the side opposite to it meets the
      // other triangle.
      case 1:
        return meets(a[1], a[2], b) || meets(b[1], b[2], a);
      case 2:
        return overlap_beside_edge(a, b);
      default:
        return false;
    }
  }

 private:
  /// Reorders the corners so that the common ones come first, in the same order. Returns their number.
  static int move_shared_first(Corners& a, Corners& b) {
    std::size_t shared = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto same = std::find(b.begin() + static_cast<std::ptrdiff_t>(shared), b.end(), a[i]);
      if (same == b.end()) continue;
      std::swap(b[shared], *same);
      std::swap(a[shared], a[i]);
      ++shared;
    }
    return static_cast<int>(shared);
  }

  Kernel::Triangle_3 triangle(const Corners& corners) const {
    return {at(corners[0]), at(corners[1]), at(corners[2])};
  }

  bool meets(std::int32_t from, std::int32_t to, const Corners& corners) const {
    return CGAL::do_intersect(Kernel::Segment_3(at(from), at(to)), triangle(corners));
  }

  /// Triangles on a common edge overlap when they lie in a plane on the same side of it.
  bool overlap_beside_edge(const Corners& a, const Corners& b) const {
    return CGAL::coplanar(at(a[0]), at(a[1]), at(a[2]), at(b[2])) &&
           CGAL::coplanar_orientation(at(a[0]), at(a[1]), at(a[2]), at(b[2])) == CGAL::POSITIVE;
  }

  const Point& at(std::int32_t index) const { return points_[static_cast<std::size_t>(index)]; }

  const std::vector<Point>& points_;
};

}  // namespace

bool are_collinear(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return CGAL::collinear(point_of(a), point_of(b), point_of(c));
}

std::vector<std::int32_t> triangles_with_area(const Shape& shape) {
  std::vector<std::int32_t> rows;
  for (std::int32_t t = 0; t < shape.triangle_count(); ++t)
    if (!are_collinear(shape.corner(t, 0), shape.corner(t, 1), shape.corner(t, 2))) rows.push_back(t);
  return rows;
}

namespace {

/// Calls `found` with each pair of sheaves whose triangles intersect.
template <class Found>
void find_intersections(const Points& points, const Triangles& triangles, const Found& found) {
  std::vector<Point> exact_points;
  exact_points.reserve(static_cast<std::size_t>(points.rows()));
  for (const auto point : points.rowwise()) exact_points.push_back(point_of(point.transpose()));

  const std::vector<Sheaf> sheaves = sheaves_of(triangles);
  std::vector<Box> boxes;
  for (const Sheaf& sheaf : sheaves) {
    const Corners& corners = sheaf.corners;
    const Point& a = exact_points[static_cast<std::size_t>(corners[0])];
    const Point& b = exact_points[static_cast<std::size_t>(corners[1])];
    const Point& c = exact_points[static_cast<std::size_t>(corners[2])];
    if (!CGAL::collinear(a, b, c)) boxes.emplace_back(a.bbox() + b.bbox() + c.bbox(), &sheaf);
  }
  std::vector<const Box*> pointers;
  for (const Box& box : boxes) pointers.push_back(&box);

  const PairTest test(exact_points);
  CGAL::box_self_intersection_d(pointers.begin(), pointers.end(), [&](const Box* a, const Box* b) {
    if (test.intersect(a->info()->corners, b->info()->corners)) found(*a->info(), *b->info());
  });
}

}  // namespace

std::int64_t count_self_intersections(const Points& points, const Triangles& triangles) {
  std::int64_t count = 0;
  find_intersections(points, triangles, [&](const Sheaf& a, const Sheaf& b) {
    count += static_cast<std::int64_t>(a.rows.size() * b.rows.size());
  });
  return count;
}

std::vector<std::pair<std::int32_t, std::int32_t>> self_intersections(const Points& points,
                                                                      const Triangles& triangles) {
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  find_intersections(points, triangles, [&](const Sheaf& a, const Sheaf& b) {
    for (const std::int32_t first : a.rows)
      for (const std::int32_t second : b.rows) pairs.push_back(std::minmax({first, second}));
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace stackabilization
