#include "stackabilization/envelope/contact_polygons.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "stackabilization/envelope/exact_pair.h"
#include "stackabilization/envelope/node_pair.h"

namespace stackabilization::detail {
namespace {

/// A corner of a clipped polygon: projected position and the heights of both triangles there.
struct Corner {
  double x, y, upper, lower;

  double gap() const { return upper - lower; }
};

Corner between(const Corner& a, const Corner& b, double t) {
  const auto mix = [t](double from, double to) { return from + t * (to - from); };
  return {mix(a.x, b.x), mix(a.y, b.y), mix(a.upper, b.upper), mix(a.lower, b.lower)};
}

/// What of the convex polygon has value >= 0, for a function that is linear on it.
template <typename Value>
std::vector<Corner> clip(const std::vector<Corner>& polygon, const Value& value) {
  std::vector<Corner> kept;
  for (std::size_t c = 0; c < polygon.size(); ++c) {
    const Corner &a = polygon[c], &b = polygon[(c + 1) % polygon.size()];
    const double at_a = value(a), at_b = value(b);
    if (at_a >= 0) kept.push_back(a);
    if ((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0)) kept.push_back(between(a, b, at_a / (at_a - at_b)));
  }
  return kept;
}

double cross(const ProjectedTriangle& triangle, int p, int q, double x, double y) {
  return (triangle.x[q] - triangle.x[p]) * (y - triangle.y[p]) -
         (triangle.y[q] - triangle.y[p]) * (x - triangle.x[p]);
}

/// Height of the triangle's plane, kept within the triangle's heights: slivers seen edge-on extrapolate
/// wildly.
double height_over(const ProjectedTriangle& triangle, double x, double y) {
  double weighted = 0;
  for (int c = 0; c < 3; ++c) weighted += cross(triangle, (c + 1) % 3, (c + 2) % 3, x, y) * triangle.h[c];
  const double height = weighted / triangle.area;
  return std::isfinite(height) ? std::clamp(height, triangle.h_low, triangle.h_high) : triangle.h_high;
}

std::vector<Corner> common_polygon(const ProjectedTriangle& upper, const ProjectedTriangle& lower) {
  std::vector<Corner> polygon;
  for (int c = 0; c < 3; ++c) polygon.push_back({upper.x[c], upper.y[c], upper.h[c], 0});
  const double sign = lower.area < 0 ? -1 : 1;
  for (int edge = 0; edge < 3 && !polygon.empty(); ++edge)
    polygon = clip(polygon, [&](const Corner& corner) {
      return sign * cross(lower, edge, (edge + 1) % 3, corner.x, corner.y);
    });
  for (Corner& corner : polygon) corner.lower = height_over(lower, corner.x, corner.y);
  return polygon;
}

/// All pairs of triangles that may reach the floor, by descending the tree against itself.
class ContactSearch {
 public:
  ContactSearch(const SeparationTree::Data& tree, const Direction& direction, Semantics semantics,
                double floor)
      : tree_(tree),
        projection_(direction, tree.magnitude, semantics),
        bound_(tree.magnitude),
        nodes_(tree.nodes),
        floor_(floor * std::abs(projection_.shear.r[projection_.shear.k])),
        cut_{std::nextafter(floor_, -infinity), 0} {}

  std::vector<ContactPolygon> run() {
    std::vector<std::pair<std::int32_t, std::int32_t>> open{{0, 0}};
    while (!open.empty()) {
      const auto [a, b] = open.back();
      open.pop_back();
      if (bound_(nodes_.get(a, projection_), nodes_.get(b, projection_), cut_) <= cut_) continue;
      const TreeNode &upper = tree_.nodes[a], &lower = tree_.nodes[b];
      if (upper.count > 0 && lower.count > 0) {
        collect(upper, lower);
      } else if (lower.count > 0 || (upper.count == 0 && a <= b)) {
        open.push_back({upper.first, b});
        open.push_back({upper.first + 1, b});
      } else {
        open.push_back({a, lower.first});
        open.push_back({a, lower.first + 1});
      }
    }
    return polygons();
  }

 private:
  struct Pair {
    std::int32_t upper, lower;        ///< triangles of the shape
    std::int32_t upper_at, lower_at;  ///< the same in tree order

    friend bool operator<(const Pair& a, const Pair& b) {
      return a.upper != b.upper ? a.upper < b.upper : a.lower < b.lower;
    }
  };

  void collect(const TreeNode& upper, const TreeNode& lower) {
    for (std::int32_t a = upper.first; a < upper.first + upper.count; ++a)
      for (std::int32_t b = lower.first; b < lower.first + lower.count; ++b)
        pairs_.push_back({tree_.triangles[a].index, tree_.triangles[b].index, a, b});
  }

  std::vector<ContactPolygon> polygons() {
    std::sort(pairs_.begin(), pairs_.end());
    std::vector<std::optional<ContactPolygon>> found(pairs_.size());
    tbb::parallel_for(std::size_t{0}, pairs_.size(),
                      [&](std::size_t p) { found[p] = polygon_of(pairs_[p]); });
    std::vector<ContactPolygon> result;
    for (std::optional<ContactPolygon>& polygon : found)
      if (polygon) result.push_back(std::move(*polygon));
    return result;
  }

  std::optional<ContactPolygon> polygon_of(const Pair& pair) const {
    const ProjectedTriangle upper(tree_.triangles[pair.upper_at], projection_);
    const ProjectedTriangle lower(tree_.triangles[pair.lower_at], projection_);
    const PairBounds bounds = bound_pair(upper, lower, projection_, cut_);
    if (bounds.high <= cut_) return std::nullopt;
    // Neighbours of a contact that only share an edge with it in projection would come as slivers of
    // rounding.
    const bool certain = bounds.low.high > -infinity;
    if (!certain && !exact_maximum(tree_.triangles[pair.upper_at], tree_.triangles[pair.lower_at],
                                   projection_.shear, projection_.semantics))
      return std::nullopt;
    const std::vector<Corner> polygon =
        clip(common_polygon(upper, lower), [this](const Corner& corner) { return corner.gap() - floor_; });
    if (polygon.empty()) return std::nullopt;
    return lift(pair, polygon);
  }

  ContactPolygon lift(const Pair& pair, const std::vector<Corner>& polygon) const {
    ContactPolygon result{pair.upper, pair.lower, Points(polygon.size(), 3), Points(polygon.size(), 3)};
    for (std::size_t c = 0; c < polygon.size(); ++c) {
      result.upper_points.row(static_cast<Eigen::Index>(c)) = lift(polygon[c], polygon[c].upper);
      result.lower_points.row(static_cast<Eigen::Index>(c)) = lift(polygon[c], polygon[c].lower);
    }
    return result;
  }

  Eigen::RowVector3d lift(const Corner& corner, double height) const {
    const Shear& shear = projection_.shear;
    Eigen::RowVector3d point;
    point[shear.i] = corner.x + height * shear.sx;
    point[shear.j] = corner.y + height * shear.sy;
    point[shear.k] = shear.sign * height;
    for (int axis = 0; axis < 3; ++axis) point[axis] += tree_.origin[axis];
    return point;
  }

  const SeparationTree::Data& tree_;
  Projection projection_;
  NodePairBound bound_;
  ProjectedNodes nodes_;
  double floor_;      ///< as a height difference
  DoubleDouble cut_;  ///< just below the floor
  std::vector<Pair> pairs_;
};

}  // namespace

std::vector<ContactPolygon> contact_polygons(const SeparationTree::Data& tree, const Direction& direction,
                                             Semantics semantics, double floor) {
  return ContactSearch(tree, direction, semantics, floor).run();
}

}  // namespace stackabilization::detail
