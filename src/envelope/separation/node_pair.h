#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "envelope/separation/separation_tree.h"
#include "envelope/separation/triangle_pair.h"

namespace stackabilization::detail {

/// Number of axes besides that of the height along which two nodes bound their height difference: two of the
/// file and the diagonals.
inline constexpr int oblique_count = 2 + diagonal_count;

/// A node seen along a direction: ranges of its projection and heights, and its slab in those coordinates,
///   slab_low <= n_x x + n_y y + slope H <= slab_high.
/// For each of eight axes m, the points p of the node have m.p / m.(sx, sy, sign) in an oblique range. This
/// number grows along a column as H does, so each range bounds the height difference of two nodes as their
/// heights do. Together, they clip a line along r to the Minkowski difference of the two bounding volumes.
struct ProjectedNode {
  double x_low, x_high, y_low, y_high, h_low, h_high;
  double n_x, n_y, slope, inverse_slope;  ///< inverse_slope is 0 where the slab is too steep to bound heights
  double slab_low, slab_high;
  std::array<double, oblique_count> oblique_low, oblique_high;  ///< infinite where m is nearly across r

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
    std::array<double, 3> ray;
    ray[shear.i] = shear.sx;
    ray[shear.j] = shear.sy;
    ray[shear.k] = shear.sign;
    for (int diagonal = 0; diagonal < diagonal_count; ++diagonal)
      set_oblique(diagonal, node.diagonal_low[diagonal], node.diagonal_high[diagonal],
                  along_diagonal(ray.data(), diagonal), projection.magnitude);
    set_oblique(diagonal_count, node.low[shear.i], node.high[shear.i], shear.sx, projection.magnitude);
    set_oblique(diagonal_count + 1, node.low[shear.j], node.high[shear.j], shear.sy, projection.magnitude);
  }

  /// Smallest |slope| of a slab that bounds heights: smaller slopes would amplify rounding errors.
  static constexpr double steepest = 1.0 / 256;

 private:
  /// Sets the range of an axis m from low <= m.p <= high; `rise` is m.(sx, sy, sign).
  ///
  /// The margin covers what a difference of two ranges may be off by, over |rise|: the rise by 4 unit
  /// roundoffs, times a height difference of at most 2 magnitudes; each of two offsets, of at most 2
  /// magnitudes, by the rounding of the reciprocal, of the product and of the margin; the difference, of at
  /// most 4 magnitudes, by its own. That is 24 unit roundoffs of the magnitude, and two margins have 32.
  void set_oblique(int axis, double low, double high, double rise, double magnitude) {
    if (std::abs(rise) <= steepest) {
      oblique_low[axis] = -infinity;
      oblique_high[axis] = infinity;
      return;
    }
    const double inverse = 1 / rise, margin = 16 * unit_roundoff * magnitude * std::abs(inverse);
    oblique_low[axis] = std::min(low * inverse, high * inverse) - margin;
    oblique_high[axis] = std::max(low * inverse, high * inverse) + margin;
  }
};

/// The projected nodes of a tree, computed on first use. Memory is taken page by page: a query of a million
/// triangles sees a few hundred nodes.
class ProjectedNodes {
 public:
  explicit ProjectedNodes(const std::vector<TreeNode>& nodes)
      : nodes_(nodes), pages_((nodes.size() + page_size - 1) / page_size) {}

  const ProjectedNode& get(std::int32_t index, const Projection& projection) {
    std::unique_ptr<Page>& page = pages_[index / page_size];
    if (!page) {
      page = std::make_unique_for_overwrite<Page>();
      page->known.fill(false);
    }
    ProjectedNode& node = page->nodes[index % page_size];
    bool& known = page->known[index % page_size];
    if (!known) {
      node = ProjectedNode(nodes_[index], projection);
      known = true;
    }
    return node;
  }

 private:
  static constexpr std::size_t page_size = 256;
  struct Page {
    std::array<ProjectedNode, page_size> nodes;
    std::array<bool, page_size> known;
  };

  const std::vector<TreeNode>& nodes_;
  std::vector<std::unique_ptr<Page>> pages_;
};

inline const std::vector<TreeNode> no_nodes;

/// The intersection of the rectangles of two projected nodes.
struct CommonRectangle {
  double x, y, half_width, half_height;
  bool empty;

  CommonRectangle(const ProjectedNode& a, const ProjectedNode& b) {
    const double x_low = std::max(a.x_low, b.x_low), x_high = std::min(a.x_high, b.x_high);
    const double y_low = std::max(a.y_low, b.y_low), y_high = std::min(a.y_high, b.y_high);
    empty = x_low > x_high || y_low > y_high;
    x = (x_low + x_high) / 2;
    y = (y_low + y_high) / 2;
    half_width = (x_high - x_low) / 2;
    half_height = (y_high - y_low) / 2;
  }
};

/// What the oblique ranges of two nodes leave of the height differences (upper minus lower) in a column.
struct ObliqueDifference {
  double low = -infinity, high = infinity;

  ObliqueDifference(const ProjectedNode& upper, const ProjectedNode& lower) {
    for (int axis = 0; axis < oblique_count; ++axis) {
      low = std::max(low, upper.oblique_low[axis] - lower.oblique_high[axis]);
      high = std::min(high, upper.oblique_high[axis] - lower.oblique_low[axis]);
    }
  }
};

/// Range of heights of a node over a rectangle; empty when its slab has no point over it.
struct HeightRange {
  double low, high;
  bool empty;

  HeightRange(const ProjectedNode& node, const CommonRectangle& rectangle, double rounding)
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

/// Upper bound of the height difference (upper minus lower) over common columns of two nodes. In the header
/// because nearly all the time of a query is spent here.
class NodePairBound {
 public:
  /// `magnitude`: largest absolute coordinate of both shapes.
  explicit NodePairBound(double magnitude)
      : rounding_(16 * unit_roundoff * magnitude), plane_rounding_(64 * unit_roundoff * magnitude) {}

  /// Returns the bound, or -inf when the nodes have no common columns or certainly nothing above `floor`.
  DoubleDouble operator()(const ProjectedNode& upper, const ProjectedNode& lower,
                          const DoubleDouble& floor) const {
    constexpr DoubleDouble none{-infinity, 0};
    const CommonRectangle common(upper, lower);
    const DoubleDouble boxes = exact_difference(upper.h_high, lower.h_low);
    if (common.empty || boxes <= floor) return none;
    const ObliqueDifference oblique(upper, lower);
    if (DoubleDouble{oblique.high, 0} <= floor) return none;
    // Differences of heights are rounded, but by less than the margins of the oblique ranges.
    if (std::max(oblique.low, upper.h_low - lower.h_high) > std::min(oblique.high, boxes.high)) return none;
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
    planes += plane_rounding_ * std::max({1.0, std::abs(upper.inverse_slope), std::abs(lower.inverse_slope)});
    const double high = std::min(planes, oblique.high);
    return high < boxes.high ? DoubleDouble{high, 0} : boxes;
  }

 private:
  double rounding_;        ///< error of n.p within the shapes: three products and their sums, |n| <= 1
  double plane_rounding_;  ///< error of the difference of two planes within the shapes, for slopes up to 1
};

}  // namespace stackabilization::detail
