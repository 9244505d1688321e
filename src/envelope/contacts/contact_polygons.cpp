#include "envelope/contacts/contact_polygons.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "envelope/contacts/contact_pairs.h"
#include "envelope/separation/exact_pair.h"
#include "mesh/clip.h"

namespace stackabilization::detail {
namespace {

/// A corner of a clipped polygon: projected position and the heights of both triangles there.
struct LoopCorner {
  double x, y, upper, lower;

  double gap() const { return upper - lower; }
};

LoopCorner between(const LoopCorner& a, const LoopCorner& b, double t) {
  const auto mix = [t](double from, double to) { return from + t * (to - from); };
  return {mix(a.x, b.x), mix(a.y, b.y), mix(a.upper, b.upper), mix(a.lower, b.lower)};
}

double edge_side(const ProjectedTriangle& triangle, int p, int q, double x, double y) {
  return (triangle.x[q] - triangle.x[p]) * (y - triangle.y[p]) -
         (triangle.y[q] - triangle.y[p]) * (x - triangle.x[p]);
}

/// Returns the height of the triangle's plane, clamped to the heights of the triangle: the extrapolation of
/// edge-on slivers is unreliable.
double height_over(const ProjectedTriangle& triangle, double x, double y) {
  double weighted = 0;
  for (int c = 0; c < 3; ++c) weighted += edge_side(triangle, (c + 1) % 3, (c + 2) % 3, x, y) * triangle.h[c];
  const double height = weighted / triangle.area;
  return std::isfinite(height) ? std::clamp(height, triangle.h_low, triangle.h_high) : triangle.h_high;
}

std::vector<LoopCorner> common_polygon(const ProjectedTriangle& upper, const ProjectedTriangle& lower) {
  std::vector<LoopCorner> polygon;
  for (int c = 0; c < 3; ++c) polygon.push_back({upper.x[c], upper.y[c], upper.h[c], 0});
  const double sign = lower.area < 0 ? -1 : 1;
  for (int edge = 0; edge < 3 && !polygon.empty(); ++edge)
    polygon = clipped(
        polygon,
        [&](const LoopCorner& corner) {
          return sign * edge_side(lower, edge, (edge + 1) % 3, corner.x, corner.y);
        },
        between);
  for (LoopCorner& corner : polygon) corner.lower = height_over(lower, corner.x, corner.y);
  return polygon;
}

/// The polygon of each pair of triangles that may have one.
class ContactClipper {
 public:
  ContactClipper(const SeparationTree::Data& tree, const Direction& direction, const ContactBand& band)
      : tree_(tree),
        projection_(direction, tree.magnitude, band.semantics),
        scale_(std::abs(projection_.shear.r[projection_.shear.k])),
        floor_(band.floor * scale_),
        cut_{std::nextafter(floor_, -infinity), 0} {}

  ContactPolygons run(const ContactBand& band) {
    const ContactPairs found =
        contact_pairs(tree_, projection_, floor_, band.max_pairs, band.resolution * scale_);
    std::vector<std::optional<ContactPolygon>> clipped(found.pairs.size());
    tbb::parallel_for(std::size_t{0}, clipped.size(),
                      [&](std::size_t p) { clipped[p] = polygon_of(found.pairs[p]); });
    ContactPolygons result;
    result.complete = found.complete;
    for (std::optional<ContactPolygon>& polygon : clipped)
      if (polygon) result.polygons.push_back(std::move(*polygon));
    return result;
  }

 private:
  std::optional<ContactPolygon> polygon_of(const ContactPair& pair) const {
    const ProjectedTriangle upper(tree_.triangles[pair.upper_at], projection_);
    const ProjectedTriangle lower(tree_.triangles[pair.lower_at], projection_);
    const PairBounds bounds = bound_pair(upper, lower, projection_, cut_);
    if (bounds.high <= cut_) return std::nullopt;
    // Neighbours of a contact that only share an edge with it in projection would otherwise give slivers from
    // rounding.
    const bool certain = bounds.low.high > -infinity;
    if (!certain && !exact_maximum(tree_.triangles[pair.upper_at], tree_.triangles[pair.lower_at],
                                   projection_.shear, projection_.semantics))
      return std::nullopt;
    const std::vector<LoopCorner> polygon = clipped(
        common_polygon(upper, lower), [this](const LoopCorner& corner) { return corner.gap() - floor_; },
        between);
    if (polygon.empty()) return std::nullopt;
    return lift(pair, polygon);
  }

  ContactPolygon lift(const ContactPair& pair, const std::vector<LoopCorner>& polygon) const {
    ContactPolygon result{pair.upper, pair.lower, Points(polygon.size(), 3), Points(polygon.size(), 3)};
    for (std::size_t c = 0; c < polygon.size(); ++c) {
      result.upper_points.row(static_cast<Eigen::Index>(c)) = lift(polygon[c], polygon[c].upper);
      result.lower_points.row(static_cast<Eigen::Index>(c)) = lift(polygon[c], polygon[c].lower);
    }
    return result;
  }

  Eigen::RowVector3d lift(const LoopCorner& corner, double height) const {
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
  double scale_;      ///< heights per unit of r
  double floor_;      ///< as a height difference
  DoubleDouble cut_;  ///< just below the floor
};

}  // namespace

ContactPolygons contact_polygons(const SeparationTree::Data& tree, const Direction& direction,
                                 const ContactBand& band) {
  return ContactClipper(tree, direction, band).run(band);
}

}  // namespace stackabilization::detail
