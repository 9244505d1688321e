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

/// A node seen along a direction: bounds of its projection, its heights, and two planes that bound its heights,
///   h <= height_at_most - gradient . (x, y),   h >= height_at_least - gradient . (x, y).
struct ProjectedNode {
  double x_low, x_high, y_low, y_high, h_low, h_high;
  double gradient_x = 0, gradient_y = 0;
  double height_at_most = infinity, height_at_least = -infinity;

  ProjectedNode(const TreeNode& node, const Projection& projection) {
    const Shear& shear = projection.shear;
    const double low = shear.sign > 0 ? node.low[shear.k] : -node.high[shear.k];
    const double high = shear.sign > 0 ? node.high[shear.k] : -node.low[shear.k];
    h_low = low;
    h_high = high;
    const double x_shift_a = low * shear.sx, x_shift_b = high * shear.sx;
    const double y_shift_a = low * shear.sy, y_shift_b = high * shear.sy;
    x_low = node.low[shear.i] - std::max(x_shift_a, x_shift_b) - projection.x_error;
    x_high = node.high[shear.i] - std::min(x_shift_a, x_shift_b) + projection.x_error;
    y_low = node.low[shear.j] - std::max(y_shift_a, y_shift_b) - projection.y_error;
    y_high = node.high[shear.j] - std::min(y_shift_a, y_shift_b) + projection.y_error;
    set_planes(node, projection);
  }

 private:
  /// A point p = (x, y) + H (sx, sy, sign) of the slab has n.p = n_i x + n_j y + H n.(sx, sy, sign).
  void set_planes(const TreeNode& node, const Projection& projection) {
    const Shear& shear = projection.shear;
    const double ni = node.normal[shear.i], nj = node.normal[shear.j], nk = shear.sign * node.normal[shear.k];
    const double slope = ni * shear.sx + nj * shear.sy + nk;
    if (!(std::abs(slope) > steepest_)) return;
    const double inverse = 1 / slope;
    gradient_x = ni * inverse;
    gradient_y = nj * inverse;
    const double a = node.slab_low * inverse, b = node.slab_high * inverse;
    height_at_most = std::max(a, b);
    height_at_least = std::min(a, b);
  }

  /// Slabs steeper than this bound nothing, and would amplify rounding.
  static constexpr double steepest_ = 1.0 / 64;
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

/// Best-first branch and bound over pairs of nodes, then triangles, by an upper bound of the height difference.
class SeparationQuery {
 public:
  SeparationQuery(const SeparationTree::Data& upper, const SeparationTree::Data& lower, const Direction& direction,
                  const SeparationOptions& options)
      : upper_(upper),
        lower_(lower),
        projection_(direction, std::max(upper.magnitude, lower.magnitude), options.semantics),
        scale_(std::abs(projection_.shear.r[projection_.shear.k])) {
    const double magnitude = std::max(upper.magnitude, lower.magnitude);
    plane_rounding_ = 65536 * unit_roundoff * magnitude;
    if (options.abandon_above) abandon_above_ = *options.abandon_above * scale_;
    push(0, ProjectedNode(upper_.nodes[0], projection_), 0, ProjectedNode(lower_.nodes[0], projection_));
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
  /// A pair whose bound only equals the floor cannot improve an enclosure, nor an exact value that is known already.
  DoubleDouble cut() const {
    if (!exact_ || attained_) return floor_;
    return {floor_.high, std::nextafter(floor_.low, -infinity)};
  }
  bool hopeless(const DoubleDouble& high) const { return high <= cut(); }

  void push(std::int32_t a, const ProjectedNode& upper, std::int32_t b, const ProjectedNode& lower) {
    const double x_low = std::max(upper.x_low, lower.x_low), x_high = std::min(upper.x_high, lower.x_high);
    const double y_low = std::max(upper.y_low, lower.y_low), y_high = std::min(upper.y_high, lower.y_high);
    if (x_low > x_high || y_low > y_high) return;
    DoubleDouble high = exact_difference(upper.h_high, lower.h_low);
    if (hopeless(high)) return;
    // The difference of two planes is largest at a corner of the rectangle.
    const double x = (x_low + x_high) / 2, y = (y_low + y_high) / 2;
    const double tilt_x = upper.gradient_x - lower.gradient_x, tilt_y = upper.gradient_y - lower.gradient_y;
    const double planes = (upper.height_at_most - lower.height_at_least) - tilt_x * x - tilt_y * y +
                          std::abs(tilt_x) * (x_high - x_low) / 2 + std::abs(tilt_y) * (y_high - y_low) / 2 +
                          plane_rounding_;
    if (planes < high.high) high = {planes, 0};
    if (hopeless(high)) return;
    tasks_.push_back({high, a, b, false});
    std::push_heap(tasks_.begin(), tasks_.end());
  }

  void expand(const Task& task) {
    const TreeNode& upper = upper_.nodes[task.upper];
    const TreeNode& lower = lower_.nodes[task.lower];
    if (upper.count > 0 && lower.count > 0) {
      test_triangles(upper, lower);
      return;
    }
    const int upper_children = upper.count > 0 ? 1 : 2, lower_children = lower.count > 0 ? 1 : 2;
    for (int a = 0; a < upper_children; ++a) {
      const std::int32_t upper_index = upper.count > 0 ? task.upper : upper.first + a;
      const ProjectedNode upper_node(upper_.nodes[upper_index], projection_);
      for (int b = 0; b < lower_children; ++b) {
        const std::int32_t lower_index = lower.count > 0 ? task.lower : lower.first + b;
        push(upper_index, upper_node, lower_index, ProjectedNode(lower_.nodes[lower_index], projection_));
      }
    }
  }

  void test_triangles(const TreeNode& upper, const TreeNode& lower) {
    for (std::int32_t a = upper.first; a < upper.first + upper.count; ++a) {
      const ProjectedTriangle upper_triangle(upper_.triangles[a], projection_);
      for (std::int32_t b = lower.first; b < lower.first + lower.count; ++b) {
        const ProjectedTriangle lower_triangle(lower_.triangles[b], projection_);
        const PairBounds bounds = bound_pair(upper_triangle, lower_triangle, projection_, cut());
        if (bounds.high.high == -infinity || hopeless(bounds.high)) continue;
        if (!(bounds.low <= floor_)) {
          floor_ = bounds.low;
          attained_ = false;
        }
        tasks_.push_back({bounds.high, a, b, true});
        std::push_heap(tasks_.begin(), tasks_.end());
      }
    }
  }

  void decide(const Task& task) {
    std::optional<Rational> value = exact_maximum(upper_.triangles[task.upper], lower_.triangles[task.lower],
                                                  projection_.shear, projection_.semantics);
    if (!value || (best_ && *value <= *best_)) return;
    const DoubleDouble height = lower_bound(*value * Rational(scale_));
    if (floor_ <= height) {
      floor_ = height;
      attained_ = true;
    }
    best_ = std::move(value);
    best_upper_ = task.upper;
    best_lower_ = task.lower;
  }

  const SeparationTree::Data& upper_;
  const SeparationTree::Data& lower_;
  Projection projection_;
  double scale_;     ///< heights per unit of r
  double plane_rounding_;  ///< bound on the rounding of the difference of two planes within the shapes
  double abandon_above_ = infinity;
  DoubleDouble floor_{-infinity, 0};  ///< certified lower bound of the answer, as a height difference
  bool attained_ = false;             ///< `best_` is at least `floor_`
  bool exact_ = true;
  bool abandoned_ = false;
  std::vector<Task> tasks_;  ///< binary heap
  std::optional<Rational> best_;
  std::int32_t best_upper_ = -1, best_lower_ = -1;
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

Enclosure separation_enclosure(const SeparationTree& below, const SeparationTree& above, const Direction& direction,
                               const SeparationOptions& options) {
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
