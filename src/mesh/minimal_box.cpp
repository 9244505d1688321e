#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include "mesh/affine_span.h"
#include "mesh/box_view.h"
#include "mesh/gauss_arcs.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/mesh/boxes.h"

namespace stackabilization {

using detail::GaussArc;
using detail::GaussArcTree;

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

/// Faces that are tried before all others: the largest ones.
constexpr Eigen::Index first_faces = 12;

/// Boxes that are larger than the best one by less than this fraction are not looked for: the volume is the
/// same in every pose to tolerance::relative.
constexpr double negligible = 0.1 * tolerance::relative;

/// Distance from the end of an interval at which the body is looked at, radians: there it shows which corners
/// support it from the end on. What changes within this distance changes the result by little more than the
/// accuracy of boxes.
constexpr double beside = 0.1 * tolerance::relative;

/// Regions of directions wider than this (radians) are divided without a look at them.
constexpr double wide = 0.4;

/// Tries of one interval, each with another place where the bounds from both ends may meet, at least so far
/// (share of what is left) from the last ones.
constexpr int tries = 8;
constexpr double min_step = 0.02;

/// Returns the number of boxes that the work of one search allows.
int max_boxes(const HullSupport& hull) {
  return static_cast<int>(total_effort / effort_per_box(hull));
}

/// Branch and bound over the arcs of a hull: regions of the sphere are divided until they are single arcs,
/// and these where the bounds from their ends meet.
class MinimalBoxSearch {
 public:
  MinimalBoxSearch(const HullSupport& hull, int boxes)
      : hull_(hull),
        unit_(std::ldexp(1.0, std::min(working_exponent(hull.points()), 1000))),
        boxes_left_(boxes),
        face_visited_(static_cast<std::size_t>(hull.face_normals().rows())) {}

  /// Searches all directions.
  OrientedBox run() {
    return search([](const Eigen::Vector3d&) { return true; });
  }

  /// Searches near the axes of the best box that is found from boxes along `normals`, when axes across it are
  /// taken for its normal in turn.
  OrientedBox run_near(const std::vector<Eigen::Vector3d>& normals) {
    for (const Eigen::Vector3d& normal : normals) follow(normal);
    const Eigen::Matrix3d axes = best_.axes;
    return search([&](const Eigen::Vector3d& normal) {
      return (axes.transpose() * normal).cwiseAbs().maxCoeff() >= std::cos(surroundings);
    });
  }

  /// Returns the best directions of all that were visited, the best first.
  std::vector<Eigen::Vector3d> best_directions() const;

 private:
  using View = std::shared_ptr<const detail::BoxView>;

  /// A part of an arc, with the body seen from beside its ends; or a node of the tree, which has no view.
  struct Task {
    double bound = 0;
    int node = -1, arc = -1;
    double low = 0, high = 0;  ///< angles on the arc
    View at_low, at_high;
    double meeting = 0;  ///< angle at which the bounds from both ends meet
    int order = 0;

    bool operator<(const Task& other) const {  // smallest bound on top of a priority queue
      return std::tie(bound, order) > std::tie(other.bound, other.order);
    }
  };

  OrientedBox search(const std::function<bool(const Eigen::Vector3d&)>& wanted);

  double volume(const OrientedBox& box) const { return (unit_ * 2 * box.half_extents).prod(); }
  bool cannot_win(double bound) const { return bound >= best_volume_ * (1 - negligible); }

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

  View look(const Eigen::Vector3d& normal) {
    --boxes_left_;
    auto view = std::make_shared<const detail::BoxView>(hull_, normal, unit_);
    visited_.emplace_back(view->volume(), normal);
    if (view->volume() < best_volume_) box_along(normal);
    return view;
  }

  void visit_face(int face) {
    if (face_visited_[static_cast<std::size_t>(face)]) return;
    face_visited_[static_cast<std::size_t>(face)] = true;
    box_along(hull_.face_normals().row(face).transpose());
  }

  /// Takes the axes across the box along `normal` for its normal, as long as that makes it smaller.
  void follow(const Eigen::Vector3d& normal);
  void push(Task task) {
    if (cannot_win(task.bound)) return;
    task.order = tasks_made_++;
    tasks_.push(std::move(task));
  }
  void push_node(const GaussArcTree& tree, int node, double bound);
  void push_interval(int arc, double low, double high);
  void divide(const Task& interval);

  const HullSupport& hull_;
  double unit_;  ///< lengths times it have volumes that neither overflow nor underflow
  int boxes_left_;
  OrientedBox best_;
  double best_volume_ = std::numeric_limits<double>::infinity();
  std::vector<std::pair<double, Eigen::Vector3d>> visited_;  ///< volumes and normals
  std::vector<bool> face_visited_;
  std::vector<GaussArc> arcs_;
  std::priority_queue<Task> tasks_;
  int tasks_made_ = 0;
};

OrientedBox MinimalBoxSearch::search(const std::function<bool(const Eigen::Vector3d&)>& wanted) {
  for (Eigen::Index face = 0; face < std::min(first_faces, hull_.face_normals().rows()); ++face)
    if (!hull_.face_normals().row(face).isZero()) visit_face(static_cast<int>(face));
  arcs_ = detail::without_needless_arcs(detail::gauss_arcs(hull_, wanted), best_.axes);
  const GaussArcTree tree(arcs_);
  if (!arcs_.empty()) push_node(tree, 0, 0);
  while (!tasks_.empty() && boxes_left_ > 0) {
    const Task task = tasks_.top();
    tasks_.pop();
    if (cannot_win(task.bound)) break;
    if (task.node < 0) {
      divide(task);
      continue;
    }
    const GaussArcTree::Node& node = tree.nodes()[static_cast<std::size_t>(task.node)];
    if (node.arc < 0) {
      for (const int child : {node.left, node.right}) push_node(tree, child, task.bound);
    } else {
      const GaussArc& arc = arcs_[static_cast<std::size_t>(node.arc)];
      visit_face(arc.from);
      visit_face(arc.to);
      push_interval(node.arc, 0, arc.length);
    }
  }
  return best_;
}

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

void MinimalBoxSearch::push_node(const GaussArcTree& tree, int node, double bound) {
  const auto& [centre, radius, left, right, index] = tree.nodes()[static_cast<std::size_t>(node)];
  Task task;
  task.node = node;
  task.bound = bound;
  if (radius <= wide) {
    const View view = look(centre);
    if (index < 0) {
      task.bound = std::max(bound, view->bound_within(radius));
    } else {
      const GaussArc& arc = arcs_[static_cast<std::size_t>(index)];
      task.bound = std::max(bound, std::min({view->volume(), view->bound_along(arc.normal(0)),
                                             view->bound_along(arc.normal(arc.length))}));
    }
  }
  push(std::move(task));
}

/// Where corners support the body at one end, they bound its boxes up to the other end, and bounds from both
/// ends meet in between: the interval has no smaller box than at its ends and where they meet.
void MinimalBoxSearch::push_interval(int index, double low, double high) {
  const double width = high - low;
  if (!(width > 4 * beside)) return;
  const GaussArc& arc = arcs_[static_cast<std::size_t>(index)];
  Task task;
  task.arc = index;
  task.low = low;
  task.high = high;
  task.at_low = look(arc.normal(low + beside));
  task.at_high = look(arc.normal(high - beside));
  const double ends = std::min(task.at_low->volume(), task.at_high->volume());
  task.bound = 0;
  double from = low, to = high, at_from = 0, at_to = 0, angle = (low + high) / 2;
  for (int attempt = 0; attempt < tries; ++attempt) {
    const Eigen::Vector3d normal = arc.normal(angle);
    const double below = task.at_low->bound_along(normal), above = task.at_high->bound_along(normal);
    if (attempt == 0 || std::min(below, above) > task.bound) {
      task.bound = std::min(below, above);
      task.meeting = angle;
    }
    if (cannot_win(task.bound)) break;
    (below > above ? from : to) = angle;
    (below > above ? at_from : at_to) = below - above;
    const double share = at_from > 0 && at_to < 0 ? at_from / (at_from - at_to) : 0.5;
    angle = from + (to - from) * std::clamp(share, min_step, 1 - min_step);
  }
  task.bound = std::min(task.bound, ends);
  push(std::move(task));
}

void MinimalBoxSearch::divide(const Task& interval) {
  const double middle = std::clamp(interval.meeting, interval.low + 2 * beside, interval.high - 2 * beside);
  box_along(arcs_[static_cast<std::size_t>(interval.arc)].normal(middle));
  push_interval(interval.arc, interval.low, middle);
  push_interval(interval.arc, middle, interval.high);
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
