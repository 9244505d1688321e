#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include "core/angles.h"
#include "mesh/affine_span.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/mesh/boxes.h"

namespace stackabilization {

namespace {

/// Limit of the work of one search, in visits of hull elements: a fraction of a second.
constexpr double total_effort = 1.5e8;

/// Corners of a large hull that are searched first.
constexpr Eigen::Index coarse_corners = 500;
/// So many of the best directions there, at least so far apart (radians), are followed on the whole hull. The
/// surroundings of the best of them are searched, so far (radians) and by so many boxes.
constexpr std::size_t followed_directions = 12;
constexpr double apart = 0.05;
constexpr double surroundings = 0.1;
constexpr int boxes_nearby = 500;

/// Limit of the work for one box. The corners of the silhouette must be sorted; their number is at most about
/// that of the face with most sides.
double effort_per_box(const HullSupport& hull) {
  Eigen::VectorXi sides = Eigen::VectorXi::Zero(hull.face_normals().rows());
  for (Eigen::Index e = 0; e < hull.edge_faces().rows(); ++e)
    for (int side = 0; side < 2; ++side) ++sides[hull.edge_faces()(e, side)];
  return 1000.0 + 100.0 * sides.maxCoeff() +
         static_cast<double>(hull.points().rows() + hull.edges().rows() + sides.size());
}

/// Intervals of an arc narrower than this are searched by golden section, radians.
constexpr double narrow = 0.01;

/// Distance from its end, in radians, at which the slope of such an interval is measured. A kink within this
/// distance changes the result by little more than the accuracy of boxes. A slope below rounding changes it
/// by little over the interval.
constexpr double beside = 3 * tolerance::relative;

/// Arc from one hull face normal to a neighbouring one.
struct Arc {
  Eigen::Vector3d start, side;
  double length;

  Eigen::Vector3d normal(double angle) const { return start * std::cos(angle) + side * std::sin(angle); }
};

/// The smallest box at one position of an arc, its volume up to a factor that is the same for all. A rotation
/// by a small angle d increases the volume by a factor of at most 1 + d * rate, because each side must grow
/// by d times another side to contain the shape.
struct Sample {
  double angle = 0, volume = 0, rate = 0;
};

struct Interval {
  int arc;
  Sample low, high;
  double bound;  ///< volume that boxes inside hardly go below: `rate` of both ends is taken for theirs

  double width() const { return high.angle - low.angle; }
  bool operator<(const Interval& other) const {  // smallest bound on top of a priority queue
    return std::tie(bound, arc, low.angle) > std::tie(other.bound, other.arc, other.low.angle);
  }
};

double turning_rate(const OrientedBox& box) {
  const double a = box.half_extents.z(), b = box.half_extents.x(), c = box.half_extents.y();
  return std::hypot(b / a + a / b, c / a + a / c);
}

/// Returns the number of boxes that the work of one search allows.
int max_boxes(const HullSupport& hull) {
  return static_cast<int>(total_effort / effort_per_box(hull));
}

class MinimalBoxSearch {
 public:
  MinimalBoxSearch(const HullSupport& hull, int boxes)
      : hull_(hull),
        unit_(std::ldexp(1.0, std::min(working_exponent(hull.points()), 1000))),
        boxes_left_(boxes) {}

  /// Searches all directions.
  OrientedBox run() {
    visit_faces([](const Eigen::Vector3d&) { return true; });
    return search_arcs();
  }

  /// Searches near the axes of the best box that is found from boxes along `normals`, when axes across it are
  /// taken for its normal in turn.
  OrientedBox run_near(const std::vector<Eigen::Vector3d>& normals) {
    for (const Eigen::Vector3d& normal : normals) follow(normal);
    const Eigen::Matrix3d axes = best_.axes;
    visit_faces([&](const Eigen::Vector3d& normal) {
      return (axes.transpose() * normal).cwiseAbs().maxCoeff() >= std::cos(surroundings);
    });
    return search_arcs();
  }

  /// Returns the best directions of all that were visited, the best first.
  std::vector<Eigen::Vector3d> best_directions() const;

 private:
  OrientedBox search_arcs() {
    visit_arcs();
    while (!intervals_.empty() && boxes_left_ > 0) {
      const Interval interval = intervals_.top();
      intervals_.pop();
      if (cannot_win(interval.bound)) break;
      if (interval.width() > narrow)
        split(interval);
      else
        minimise_inside(interval);
    }
    return best_;
  }

  double volume(const OrientedBox& box) const { return (unit_ * box.half_extents).prod(); }

  OrientedBox box_along(const Eigen::Vector3d& normal) {
    --boxes_left_;
    const OrientedBox box = hull_.box_along(Direction(normal));
    visited_.emplace_back(volume(box), normal);
    if (visited_.back().first < best_volume_) {
      best_ = box;
      best_volume_ = visited_.back().first;
    }
    return box;
  }

  Sample visit(const Eigen::Vector3d& normal, double angle) {
    const OrientedBox box = box_along(normal);
    return {angle, volume(box), turning_rate(box)};
  }

  bool cannot_win(double bound) const { return bound >= best_volume_ * (1 - tolerance::rounding); }

  void push(int arc, const Sample& low, const Sample& high) {
    const double growth = std::max(low.rate, high.rate) * (high.angle - low.angle) / 2;
    const double bound =
        std::min({low.volume, high.volume, std::sqrt(low.volume * high.volume) * std::exp(-growth)});
    if (!cannot_win(bound)) intervals_.push({arc, low, high, bound});
  }

  /// Takes the axes across the box along `normal` for its normal, as long as that makes it smaller.
  void follow(const Eigen::Vector3d& normal);
  void visit_faces(const std::function<bool(const Eigen::Vector3d&)>& wanted);
  void visit_arcs();
  void split(const Interval& interval);
  bool is_minimal_at_an_end(const Interval& interval);
  void minimise_inside(const Interval& interval);

  const HullSupport& hull_;
  double unit_;  ///< lengths times it have volumes that neither overflow nor underflow
  int boxes_left_;
  OrientedBox best_;
  double best_volume_ = std::numeric_limits<double>::infinity();
  std::vector<std::pair<double, Eigen::Vector3d>> visited_;  ///< volumes and normals
  std::vector<std::optional<Sample>> face_samples_;
  std::vector<Arc> arcs_;
  std::priority_queue<Interval> intervals_;
};

std::vector<Eigen::Vector3d> MinimalBoxSearch::best_directions() const {
  std::vector<std::pair<double, Eigen::Vector3d>> sorted = visited_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Eigen::Vector3d> chosen;
  for (const auto& [volume, normal] : sorted) {
    const auto near = [&normal = normal](const Eigen::Vector3d& other) {
      return std::abs(normal.dot(other)) > std::cos(apart);
    };
    if (std::none_of(chosen.begin(), chosen.end(), near)) chosen.push_back(normal);
    if (chosen.size() == followed_directions) break;
  }
  return chosen;
}

void MinimalBoxSearch::follow(const Eigen::Vector3d& normal) {
  OrientedBox box = box_along(normal);
  for (bool better = true; better && boxes_left_ > 0;) {
    better = false;
    const Eigen::Matrix3d axes = box.axes;
    for (int k = 0; k < 2; ++k) {  // the third axis is the normal of the box
      const OrientedBox next = box_along(axes.col(k));
      if (volume(next) >= volume(box) * (1 - tolerance::rounding)) continue;
      box = next;
      better = true;
    }
  }
}

/// Where there are too many, the largest faces get half of the work, and the arcs between them the rest.
void MinimalBoxSearch::visit_faces(const std::function<bool(const Eigen::Vector3d&)>& wanted) {
  int left = std::max(1, boxes_left_ / 2);
  face_samples_.resize(hull_.face_normals().rows());
  for (Eigen::Index f = 0; f < hull_.face_normals().rows() && left > 0; ++f) {
    const Eigen::Vector3d normal = hull_.face_normals().row(f).transpose();
    if (normal.isZero() || !wanted(normal)) continue;
    face_samples_[f] = visit(normal, 0);
    --left;
  }
}

void MinimalBoxSearch::visit_arcs() {
  for (Eigen::Index e = 0; e < hull_.edge_faces().rows(); ++e) {
    const int from = hull_.edge_faces()(e, 0), to = hull_.edge_faces()(e, 1);
    if (!face_samples_[from] || !face_samples_[to]) continue;
    const Eigen::Vector3d start = hull_.face_normals().row(from).transpose();
    const Eigen::Vector3d end = hull_.face_normals().row(to).transpose();
    const Eigen::Vector3d side = (end - start * start.dot(end)).stableNormalized();
    arcs_.push_back({start, side, detail::angle_between(start, end)});
    Sample high = *face_samples_[to];
    high.angle = arcs_.back().length;
    push(static_cast<int>(arcs_.size()) - 1, *face_samples_[from], high);
  }
}

void MinimalBoxSearch::split(const Interval& interval) {
  const double angle = (interval.low.angle + interval.high.angle) / 2;
  const Sample middle = visit(arcs_[interval.arc].normal(angle), angle);
  push(interval.arc, interval.low, middle);
  push(interval.arc, middle, interval.high);
}

/// Returns whether boxes grow from the end with the smaller box on. This end is then the minimum of the
/// interval.
bool MinimalBoxSearch::is_minimal_at_an_end(const Interval& interval) {
  if (interval.width() < 2 * beside) return false;
  const bool at_low = interval.low.volume <= interval.high.volume;
  const double angle = at_low ? interval.low.angle + beside : interval.high.angle - beside;
  const double volume = visit(arcs_[interval.arc].normal(angle), angle).volume;
  return volume >= (at_low ? interval.low : interval.high).volume;
}

/// Golden section: it needs no derivatives, and the minimum is often a kink where the hull touches with
/// another corner.
void MinimalBoxSearch::minimise_inside(const Interval& interval) {
  constexpr double golden = 0.6180339887498949;
  if (is_minimal_at_an_end(interval)) return;
  const Arc& arc = arcs_[interval.arc];
  double low = interval.low.angle, high = interval.high.angle;
  const auto inner = [&](double fraction) {
    const double angle = low + (high - low) * fraction;
    return visit(arc.normal(angle), angle);
  };
  Sample left = inner(1 - golden), right = inner(golden);
  while (high - low > tolerance::rounding && boxes_left_ > 0) {
    const Sample& least = left.volume <= right.volume ? left : right;
    if (cannot_win(least.volume * (1 - least.rate * (high - low)))) return;
    if (left.volume <= right.volume) {
      high = right.angle;
      right = left;
      left = inner(1 - golden);
    } else {
      low = left.angle;
      left = right;
      right = inner(golden);
    }
  }
}

/// Returns `count` points that are spread over all: each is the farthest one from those before it, and the
/// first one from the centre.
Points spread(const Points& points, Eigen::Index count) {
  Points chosen(count, 3);
  const Eigen::RowVector3d centre = points.colwise().mean();
  Eigen::VectorXd distances = (points.rowwise() - centre).rowwise().norm();
  for (Eigen::Index k = 0; k < chosen.rows(); ++k) {
    Eigen::Index farthest = 0;
    distances.maxCoeff(&farthest);
    chosen.row(k) = points.row(farthest);
    const Eigen::VectorXd from_chosen = (points.rowwise() - points.row(farthest)).rowwise().norm();
    distances = k == 0 ? from_chosen : Eigen::VectorXd(distances.cwiseMin(from_chosen));
  }
  return chosen;
}

/// Returns the direction of a straight set; z for a point.
Direction direction_of_straight_set(const Points& points) {
  const Eigen::Vector3d along = (points.row(points.rows() - 1) - points.row(0)).transpose();
  return Direction(along.isZero(0) ? Eigen::Vector3d(Eigen::Vector3d::UnitZ())
                                   : Eigen::Vector3d(along.stableNormalized()));
}

}  // namespace

OrientedBox minimal_oriented_box(const HullSupport& hull) {
  if (hull.dimension() < 2) return hull.box_along(direction_of_straight_set(hull.points()));
  if (hull.dimension() == 2) return hull.box_along(Direction(hull.face_normals().row(0).transpose()));
  if (hull.points().rows() <= large_hull) return MinimalBoxSearch(hull, max_boxes(hull)).run();
  const HullSupport coarse(spread(hull.points(), coarse_corners));
  if (coarse.dimension() < 3) return MinimalBoxSearch(hull, max_boxes(hull)).run();
  MinimalBoxSearch search(coarse, max_boxes(coarse));
  search.run();
  return MinimalBoxSearch(hull, boxes_nearby).run_near(search.best_directions());
}

}  // namespace stackabilization
