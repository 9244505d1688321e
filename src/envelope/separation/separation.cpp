#include "stackabilization/envelope/separation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "envelope/separation/common_frame.h"
#include "envelope/separation/edge_on_triangles.h"
#include "envelope/separation/exact_pair.h"
#include "envelope/separation/node_pair.h"
#include "envelope/separation/separation_tree.h"
#include "envelope/separation/triangle_pair.h"
#include "stackabilization/envelope/tolerances.h"

namespace stackabilization {
namespace {

using namespace detail;

/// A pair to be examined: two nodes, or two triangles when `triangles` is set.
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

/// Share of the extent within which two bounds count as equally good, so that the pair that was met last is
/// examined first. Pairs this near the best have to be examined anyway, nearly all of them, and a stack costs
/// less than a heap: where walls slide, thousands of pairs tie.
constexpr double near_share = 1.0 / 256;

/// Best-first branch and bound over pairs of nodes, then triangles, by an upper bound of the height
/// difference; depth first among pairs that are nearly as good as the best.
class SeparationQuery {
 public:
  SeparationQuery(const SeparationTree::Data& upper, const SeparationTree::Data& lower,
                  const Direction& direction, const SeparationOptions& options)
      : upper_(upper),
        lower_(lower),
        projection_(direction, std::max(upper.magnitude, lower.magnitude), options.semantics),
        scale_(std::abs(projection_.shear.r[projection_.shear.k])),
        node_bound_(std::max(upper.magnitude, lower.magnitude)),
        upper_nodes_(upper.nodes),
        lower_nodes_(&upper == &lower ? no_nodes : lower.nodes),
        upper_edge_on_(upper.triangles, projection_),
        lower_edge_on_(lower.triangles, projection_) {
    max_queue_ = static_cast<std::size_t>(std::max(options.max_queue, std::int64_t{0}));
    if (options.abandon_above) abandon_above_ = *options.abandon_above * scale_;
    near_ = near_share * extent();
    push(bounded(0, 0));
  }

  /// Runs until the bounds differ by at most `width` (heights). With width 0, until the exact value is known.
  void run(double width) {
    width_ = width;
    while (!tasks_.empty() || !stack_.empty()) {
      if (floor_.high > abandon_above_) {
        abandoned_ = true;
        return;
      }
      if (stack_.empty() && hopeless(tasks_.front().high)) return;
      const Task task = next();
      if (!hopeless(task.high)) work_on(task);
    }
  }

  /// Of both shapes along the axis that serves as height.
  double extent() {
    const ProjectedNode &a = upper_node(0), &b = lower_node(0);
    return std::max(a.h_high, b.h_high) - std::min(a.h_low, b.h_low);
  }

  Enclosure enclosure() const {
    Enclosure result;
    result.work = work_;
    if (floor_.high == -infinity) return result;
    const auto widened = [this](double height, double towards) {
      return std::nextafter(std::nextafter(height, towards) / scale_, towards);
    };
    result.lower = widened(floor_.high, -infinity);
    result.upper = abandoned_ ? infinity : widened(std::max(floor_.high, dropped_), infinity);
    result.abandoned = abandoned_;
    return result;
  }

  Separation separation() const {
    Separation result;
    result.work = work_;
    if (!best_) return result;
    const TreeTriangle upper = upper_.in_file_axes(best_upper_), lower = lower_.in_file_axes(best_lower_);
    const ExactPoints points = exact_points(upper, lower, projection_.shear, projection_.semantics);
    result.blocked = true;
    result.value = *best_;
    result.length = best_->to_double() * projection_.shear.r.norm();
    result.witness = {upper.index, lower.index, points.upper, points.lower};
    return result;
  }

 private:
  /// Returns whether a pair with this bound can be omitted. Within the width of an enclosure it can, but its
  /// bound then counts.
  bool hopeless(const DoubleDouble& high) {
    if (high <= cut_) return true;
    if (!(high.high - floor_.high <= width_)) return false;
    dropped_ = std::max(dropped_, high.high);
    return width_ > 0;
  }

  /// A pair whose bound only equals the floor cannot improve an enclosure, nor an exact value that is known
  /// already; but a floor that no exact value attains yet must not cut off the pair that attains it.
  void raise_floor(const DoubleDouble& height, bool attained) {
    floor_ = cut_ = height;
    if (width_ == 0 && !attained) cut_.low = std::nextafter(cut_.low, -infinity);
  }

  const ProjectedNode& upper_node(std::int32_t index) { return upper_nodes_.get(index, projection_); }
  const ProjectedNode& lower_node(std::int32_t index) {
    return &upper_ == &lower_ ? upper_node(index) : lower_nodes_.get(index, projection_);
  }

  EdgeOnTriangles& lower_edge_on() { return &upper_ == &lower_ ? upper_edge_on_ : lower_edge_on_; }

  /// The pair of nodes with its bound: -inf where nothing above the cut is in it.
  Task bounded(std::int32_t a, std::int32_t b) {
    if (upper_edge_on_.contains_node(a) || lower_edge_on().contains_node(b))
      return {{-infinity, 0}, a, b, false};
    return {node_bound_(upper_node(a), lower_node(b), cut_), a, b, false};
  }

  /// Whether a pair of nodes is nearly as good as the best of the heap was.
  bool near(const Task& task) const { return !task.triangles && task.high.high >= best_bound_ - near_; }

  void push(const Task& task) {
    if (hopeless(task.high)) return;
    if (!near(task) && tasks_.size() < max_queue_) {
      tasks_.push_back(task);
      std::push_heap(tasks_.begin(), tasks_.end());
    } else {
      stack_.push_back(task);
    }
    work_.longest_queue =
        std::max(work_.longest_queue, static_cast<std::int64_t>(tasks_.size() + stack_.size()));
  }

  /// Takes the top of the stack, but a pair of triangles first that is as good: it may end the search.
  Task next() {
    if (!stack_.empty() && (tasks_.empty() || !tasks_.front().triangles || tasks_.front() < stack_.back())) {
      const Task task = stack_.back();
      stack_.pop_back();
      return task;
    }
    const Task task = tasks_.front();
    std::pop_heap(tasks_.begin(), tasks_.end());
    tasks_.pop_back();
    best_bound_ = task.high.high;
    return task;
  }

  void work_on(const Task& task) {
    if (task.triangles) {
      decide(task);
    } else {
      descend(task);
    }
  }

  static double width(const ProjectedNode& node) {
    return node.x_high - node.x_low + node.y_high - node.y_low + node.h_high - node.h_low;
  }

  /// Expands a pair of nodes, and its better half as long as that is near the best: most pairs never enter
  /// the heap.
  void descend(Task task) {
    for (;;) {
      ++work_.node_pairs;
      const TreeNode& upper = upper_.nodes[task.upper];
      const TreeNode& lower = lower_.nodes[task.lower];
      if (upper.count > 0 && lower.count > 0) {
        test_triangles(upper, lower);
        return;
      }
      // Splitting the wider node only costs two bounds instead of four, and most halves drop out at once.
      const bool split_upper = lower.count > 0 || (upper.count == 0 && width(upper_node(task.upper)) >=
                                                                           width(lower_node(task.lower)));
      Task first = split_upper ? bounded(upper.first, task.lower) : bounded(task.upper, lower.first);
      Task second = split_upper ? bounded(upper.first + 1, task.lower) : bounded(task.upper, lower.first + 1);
      if (first < second) std::swap(first, second);
      push(second);
      if (!near(first)) {
        push(first);
        return;
      }
      if (hopeless(first.high)) return;
      task = first;
    }
  }

  void test_triangles(const TreeNode& upper, const TreeNode& lower) {
    std::array<ProjectedTriangle, leaf_size> lower_triangles;
    for (std::int32_t b = 0; b < lower.count; ++b)
      lower_triangles[b] = ProjectedTriangle(lower_.triangles[lower.first + b], projection_);
    for (std::int32_t a = upper.first; a < upper.first + upper.count; ++a) {
      const ProjectedTriangle upper_triangle(upper_.triangles[a], projection_);
      for (std::int32_t b = 0; b < lower.count; ++b) {
        ++work_.triangle_pairs;
        const PairBounds bounds = bound_pair(upper_triangle, lower_triangles[b], projection_, cut_);
        if (!(bounds.low <= floor_)) raise_floor(bounds.low, false);
        if (hopeless(bounds.high)) continue;
        if (upper_edge_on_.contains(a, upper_triangle) ||
            lower_edge_on().contains(lower.first + b, lower_triangles[b]))
          ++edge_on_pairs_;
        else
          push({bounds.high, a, lower.first + b, true});
      }
    }
    // Where that many pairs were in vain, the surface is mostly along r: deciding all of it costs no more.
    if (edge_on_pairs_ > upper_.triangles.size() && !upper_edge_on_.nodes_decided()) {
      upper_edge_on_.decide_nodes(upper_.nodes);
      if (&upper_ != &lower_) lower_edge_on_.decide_nodes(lower_.nodes);
    }
  }

  void decide(const Task& task) {
    ++work_.exact_pairs;
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
  double scale_;  ///< heights per unit of r
  NodePairBound node_bound_;
  double abandon_above_ = infinity;
  DoubleDouble floor_{-infinity, 0};  ///< certified lower bound of the answer, as a height difference
  DoubleDouble cut_{-infinity, 0};    ///< pairs bounded by this are out
  double width_ = 0;                  ///< of the enclosure asked for; 0: the exact value
  double dropped_ = -infinity;        ///< largest bound left out within that width
  bool abandoned_ = false;
  std::size_t max_queue_ = 0;
  double best_bound_ = infinity;  ///< of the pair that left the heap last
  double near_ = 0;               ///< heights by which a bound may be less and is as good
  std::vector<Task> tasks_;       ///< binary heap
  std::vector<Task> stack_;  ///< what is near the best, and what the heap had no room for; the last is next
  SeparationWork work_;
  ProjectedNodes upper_nodes_, lower_nodes_;  ///< the second is empty where both shapes are one
  EdgeOnTriangles upper_edge_on_, lower_edge_on_;
  std::size_t edge_on_pairs_ = 0;  ///< pairs of triangles left out since one of them is edge-on
  std::optional<Rational> best_;
  std::int32_t best_upper_ = -1, best_lower_ = -1;  ///< in tree order
};

}  // namespace

Separation separation(const SeparationTree& below, const SeparationTree& above, const Direction& direction,
                      const SeparationOptions& options) {
  const CommonFrame frame(below, above);
  SeparationOptions exact = options;
  exact.abandon_above.reset();
  SeparationQuery query(frame.below(), frame.above(), direction, exact);
  query.run(0);
  return query.separation();
}

Enclosure separation_enclosure(const SeparationTree& below, const SeparationTree& above,
                               const Direction& direction, const SeparationOptions& options) {
  const CommonFrame frame(below, above);
  SeparationQuery query(frame.below(), frame.above(), direction, options);
  query.run(tolerance::enclosure_width * query.extent());
  return query.enclosure();
}

Separation minimal_stacking_translation(const Shape& shape, const Direction& direction,
                                        const SeparationOptions& options) {
  const SeparationTree tree(shape);
  return separation(tree, tree, direction, options);
}

}  // namespace stackabilization
