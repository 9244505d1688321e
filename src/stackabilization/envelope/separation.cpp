#include "stackabilization/envelope/separation.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "stackabilization/envelope/exact_pair.h"
#include "stackabilization/envelope/separation_tree.h"
#include "stackabilization/envelope/triangle_pair.h"
#include "stackabilization/shape/tolerances.h"

namespace stackabilization {
namespace {

using namespace detail;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A node seen along a direction: ranges of its projection and heights, and its slab in those coordinates,
///   slab_low <= n_x x + n_y y + slope H <= slab_high.
struct ProjectedNode {
  double x_low, x_high, y_low, y_high, h_low, h_high;
  double n_x, n_y, slope, inverse_slope;  ///< inverse_slope is 0 where the slab is too steep to bound heights
  double slab_low, slab_high;

  ProjectedNode() = default;
  ProjectedNode(const TreeNode& node, const Projection& projection) {
    const Shear& shear = projection.shear;
    h_low = shear.sign > 0 ? node.low[shear.k] : -node.high[shear.k];
    h_high = shear.sign > 0 ? node.high[shear.k] : -node.low[shear.k];
    const double x_shift_a = h_low * shear.sx, x_shift_b = h_high * shear.sx;
    const double y_shift_a = h_low * shear.sy, y_shift_b = h_high * shear.sy;
    x_low = node.low[shear.i] - std::max(x_shift_a, x_shift_b) - projection.x_error;
    x_high = node.high[shear.i] - std::min(x_shift_a, x_shift_b) + projection.x_error;
    y_low = node.low[shear.j] - std::max(y_shift_a, y_shift_b) - projection.y_error;
    y_high = node.high[shear.j] - std::min(y_shift_a, y_shift_b) + projection.y_error;
    // A point p = (x, y) + H (sx, sy, sign) has n.p = n_x x + n_y y + H n.(sx, sy, sign).
    n_x = node.normal[shear.i];
    n_y = node.normal[shear.j];
    slope = n_x * shear.sx + n_y * shear.sy + shear.sign * node.normal[shear.k];
    inverse_slope = std::abs(slope) > steepest ? 1 / slope : 0;
    slab_low = node.slab_low;
    slab_high = node.slab_high;
  }

  /// Slabs steeper than this bound no heights: they would amplify rounding more than they help.
  static constexpr double steepest = 1.0 / 256;
};

/// The projected nodes of a tree, computed when they are first asked for.
class ProjectedNodes {
 public:
  explicit ProjectedNodes(const std::vector<TreeNode>& nodes)
      : nodes_(nodes),
        projected_(std::make_unique_for_overwrite<ProjectedNode[]>(nodes.size())),
        known_(nodes.size(), 0) {}

  const ProjectedNode& get(std::int32_t index, const Projection& projection) {
    if (!known_[index]) {
      projected_[index] = ProjectedNode(nodes_[index], projection);
      known_[index] = 1;
    }
    return projected_[index];
  }

 private:
  const std::vector<TreeNode>& nodes_;
  std::unique_ptr<ProjectedNode[]> projected_;
  std::vector<char> known_;
};

const std::vector<TreeNode> no_nodes;

/// The common rectangle of two projected nodes.
struct Rectangle {
  double x, y, half_width, half_height;
  bool empty;

  Rectangle(const ProjectedNode& a, const ProjectedNode& b) {
    const double x_low = std::max(a.x_low, b.x_low), x_high = std::min(a.x_high, b.x_high);
    const double y_low = std::max(a.y_low, b.y_low), y_high = std::min(a.y_high, b.y_high);
    empty = x_low > x_high || y_low > y_high;
    x = (x_low + x_high) / 2;
    y = (y_low + y_high) / 2;
    half_width = (x_high - x_low) / 2;
    half_height = (y_high - y_low) / 2;
  }
};

/// Range of heights of a node over a rectangle; empty when its slab does not reach over it.
struct HeightRange {
  double low, high;
  bool empty;

  HeightRange(const ProjectedNode& node, const Rectangle& rectangle, double rounding)
      : low(node.h_low), high(node.h_high) {
    const double middle = node.n_x * rectangle.x + node.n_y * rectangle.y;
    const double spread =
        std::abs(node.n_x) * rectangle.half_width + std::abs(node.n_y) * rectangle.half_height + rounding;
    const double rise_low = node.slab_low - middle - spread, rise_high = node.slab_high - middle + spread;
    const double a = node.slope * node.h_low, b = node.slope * node.h_high;
    empty = rise_low > std::max(a, b) || rise_high < std::min(a, b);
    if (node.inverse_slope == 0) return;
    const double p = rise_low * node.inverse_slope, q = rise_high * node.inverse_slope;
    low = std::max(low, std::min(p, q));
    high = std::min(high, std::max(p, q));
  }
};

/// A pair still to be looked at: two nodes, or two triangles when `triangles` is set.
struct Task {
  DoubleDouble high;
  std::int32_t upper, lower;
  bool triangles;

  /// Heap order: largest bound first; equal bounds depth first, so that ties end the search soon.
  friend bool operator<(const Task& a, const Task& b) {
    if (a.high.high != b.high.high) return a.high.high < b.high.high;
    if (a.high.low != b.high.low) return a.high.low < b.high.low;
    if (a.triangles != b.triangles) return b.triangles;
    return a.upper + a.lower < b.upper + b.lower;
  }
};

/// The value as a lower bound in double-double.
DoubleDouble lower_bound(const Rational& value) {
  const double high = value.to_double();
  const Rational rest = value - Rational(high);
  double low = rest.to_double();
  if (Rational(low) > rest) low = std::nextafter(low, -infinity);
  return {high, low};
}

/// Best-first branch and bound over pairs of nodes, then triangles, by an upper bound of the height
/// difference.
class SeparationQuery {
 public:
  SeparationQuery(const SeparationTree::Data& upper, const SeparationTree::Data& lower,
                  const Direction& direction, const SeparationOptions& options)
      : upper_(upper),
        lower_(lower),
        projection_(direction, std::max(upper.magnitude, lower.magnitude), options.semantics),
        scale_(std::abs(projection_.shear.r[projection_.shear.k])),
        upper_nodes_(upper.nodes),
        lower_nodes_(&upper == &lower ? no_nodes : lower.nodes) {
    const double magnitude = std::max(upper.magnitude, lower.magnitude);
    rounding_ = 16 * unit_roundoff * magnitude;
    plane_rounding_ = 64 * unit_roundoff * magnitude / ProjectedNode::steepest;
    if (options.abandon_above) abandon_above_ = *options.abandon_above * scale_;
    push(0, 0);
  }

  /// Runs until the bounds differ by at most `width` (heights). With width 0, until the exact value is known.
  void run(double width) {
    exact_ = width == 0;
    while (!tasks_.empty()) {
      if (floor_.high > abandon_above_) {
        abandoned_ = true;
        return;
      }
      const Task task = tasks_.front();
      if (hopeless(task.high) || (width > 0 && task.high.high - floor_.high <= width)) return;
      std::pop_heap(tasks_.begin(), tasks_.end());
      tasks_.pop_back();
      if (task.triangles) {
        decide(task);
      } else {
        expand(task);
      }
    }
  }

  Enclosure enclosure() const {
    if (floor_.high == -infinity) return {};
    const auto widened = [this](double height, double towards) {
      return std::nextafter(std::nextafter(height, towards) / scale_, towards);
    };
    const double low = widened(floor_.high, -infinity);
    if (abandoned_) return {low, infinity, true};
    const bool open = !tasks_.empty() && !hopeless(tasks_.front().high);
    return {low, widened(open ? tasks_.front().high.high : floor_.high, infinity), false};
  }

  Separation separation() const {
    Separation result;
    if (!best_) return result;
    const TreeTriangle& upper = upper_.triangles[best_upper_];
    const TreeTriangle& lower = lower_.triangles[best_lower_];
    const ExactPoints points = exact_points(upper, lower, projection_.shear, projection_.semantics);
    result.blocked = true;
    result.value = *best_;
    result.length = best_->to_double() * projection_.shear.r.norm();
    result.witness = {upper.index, lower.index, points.upper, points.lower};
    return result;
  }

 private:
  bool hopeless(const DoubleDouble& high) const { return high <= cut_; }

  /// A pair whose bound only equals the floor cannot improve an enclosure, nor an exact value that is known
  /// already; but a floor that no exact value attains yet must not cut off the pair that attains it.
  void raise_floor(const DoubleDouble& height, bool attained) {
    floor_ = cut_ = height;
    if (exact_ && !attained) cut_.low = std::nextafter(cut_.low, -infinity);
  }

  /// Bound of the height difference of two nodes; -inf when they have no common columns.
  DoubleDouble bound(const ProjectedNode& upper, const ProjectedNode& lower) const {
    constexpr DoubleDouble none{-infinity, 0};
    const Rectangle common(upper, lower);
    const DoubleDouble boxes = exact_difference(upper.h_high, lower.h_low);
    if (common.empty || hopeless(boxes)) return none;
    const HeightRange above(upper, common, rounding_), beneath(lower, common, rounding_);
    if (above.empty || beneath.empty) return none;
    double planes = above.high - beneath.low;
    if (upper.inverse_slope != 0 && lower.inverse_slope != 0) {
      // The difference of two planes is largest at a corner of the rectangle.
      const double tilt_x = upper.n_x * upper.inverse_slope - lower.n_x * lower.inverse_slope;
      const double tilt_y = upper.n_y * upper.inverse_slope - lower.n_y * lower.inverse_slope;
      const double top =
          std::max(upper.slab_low * upper.inverse_slope, upper.slab_high * upper.inverse_slope);
      const double bottom =
          std::min(lower.slab_low * lower.inverse_slope, lower.slab_high * lower.inverse_slope);
      planes =
          std::min(planes, top - bottom - tilt_x * common.x - tilt_y * common.y +
                               std::abs(tilt_x) * common.half_width + std::abs(tilt_y) * common.half_height);
    }
    planes += plane_rounding_;
    return planes < boxes.high ? DoubleDouble{planes, 0} : boxes;
  }

  const ProjectedNode& upper_node(std::int32_t index) { return upper_nodes_.get(index, projection_); }
  const ProjectedNode& lower_node(std::int32_t index) {
    return &upper_ == &lower_ ? upper_node(index) : lower_nodes_.get(index, projection_);
  }

  void push(std::int32_t a, std::int32_t b) {
    const DoubleDouble high = bound(upper_node(a), lower_node(b));
    if (hopeless(high)) return;
    tasks_.push_back({high, a, b, false});
    std::push_heap(tasks_.begin(), tasks_.end());
  }

  static double width(const ProjectedNode& node) {
    return node.x_high - node.x_low + node.y_high - node.y_low + node.h_high - node.h_low;
  }

  void expand(const Task& task) {
    const TreeNode& upper = upper_.nodes[task.upper];
    const TreeNode& lower = lower_.nodes[task.lower];
    if (upper.count > 0 && lower.count > 0) {
      test_triangles(upper, lower);
      return;
    }
    // Splitting the wider node only costs two bounds instead of four, and most halves drop out at once.
    const bool split_upper = lower.count > 0 || (upper.count == 0 && width(upper_node(task.upper)) >=
                                                                         width(lower_node(task.lower)));
    for (int child = 0; child < 2; ++child)
      push(split_upper ? upper.first + child : task.upper, split_upper ? task.lower : lower.first + child);
  }

  void test_triangles(const TreeNode& upper, const TreeNode& lower) {
    std::array<ProjectedTriangle, leaf_size> lower_triangles;
    for (std::int32_t b = 0; b < lower.count; ++b)
      lower_triangles[b] = ProjectedTriangle(lower_.triangles[lower.first + b], projection_);
    for (std::int32_t a = upper.first; a < upper.first + upper.count; ++a) {
      const ProjectedTriangle upper_triangle(upper_.triangles[a], projection_);
      for (std::int32_t b = 0; b < lower.count; ++b) {
        const PairBounds bounds = bound_pair(upper_triangle, lower_triangles[b], projection_, cut_);
        if (hopeless(bounds.high)) continue;
        if (!(bounds.low <= floor_)) raise_floor(bounds.low, false);
        tasks_.push_back({bounds.high, a, lower.first + b, true});
        std::push_heap(tasks_.begin(), tasks_.end());
      }
    }
  }

  void decide(const Task& task) {
    // Pieces of the same two triangles come one after the other.
    const std::int32_t upper_index = upper_.triangles[task.upper].index,
                       lower_index = lower_.triangles[task.lower].index;
    if (upper_index == decided_upper_ && lower_index == decided_lower_) return;
    decided_upper_ = upper_index;
    decided_lower_ = lower_index;
    std::optional<Rational> value = exact_maximum(upper_.triangles[task.upper], lower_.triangles[task.lower],
                                                  projection_.shear, projection_.semantics);
    if (!value || (best_ && *value <= *best_)) return;
    const DoubleDouble height = lower_bound(*value * Rational(scale_));
    if (floor_ <= height) raise_floor(height, true);
    best_ = std::move(value);
    best_upper_ = task.upper;
    best_lower_ = task.lower;
  }

  const SeparationTree::Data& upper_;
  const SeparationTree::Data& lower_;
  Projection projection_;
  double scale_;           ///< heights per unit of r
  double rounding_;        ///< bound on the rounding of n.p within the shapes
  double plane_rounding_;  ///< bound on the rounding of the difference of two planes within the shapes
  double abandon_above_ = infinity;
  DoubleDouble floor_{-infinity, 0};  ///< certified lower bound of the answer, as a height difference
  DoubleDouble cut_{-infinity, 0};    ///< pairs bounded by this are out
  bool exact_ = true;
  bool abandoned_ = false;
  std::vector<Task> tasks_;                   ///< binary heap
  ProjectedNodes upper_nodes_, lower_nodes_;  ///< the second is empty where both shapes are one
  std::optional<Rational> best_;
  std::int32_t best_upper_ = -1, best_lower_ = -1;        ///< in tree order
  std::int32_t decided_upper_ = -1, decided_lower_ = -1;  ///< last pair decided, as triangles of the shapes
};

}  // namespace

Separation separation(const SeparationTree& below, const SeparationTree& above, const Direction& direction,
                      const SeparationOptions& options) {
  SeparationOptions exact = options;
  exact.abandon_above.reset();
  SeparationQuery query(below.data(), above.data(), direction, exact);
  query.run(0);
  return query.separation();
}

Enclosure separation_enclosure(const SeparationTree& below, const SeparationTree& above,
                               const Direction& direction, const SeparationOptions& options) {
  const double magnitude = std::max(below.data().magnitude, above.data().magnitude);
  SeparationQuery query(below.data(), above.data(), direction, options);
  query.run(tolerance::enclosure_width * magnitude);
  return query.enclosure();
}

Separation minimal_stacking_translation(const Shape& shape, const Direction& direction,
                                        const SeparationOptions& options) {
  const SeparationTree tree(shape);
  return separation(tree, tree, direction, options);
}

}  // namespace stackabilization
