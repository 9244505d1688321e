#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <vector>

#include "stackabilization/envelope/separation.h"
#include "stackabilization/envelope/tolerances.h"

namespace stackabilization {

/// Type of a contact region (section 4.2 of the paper). `ring` has an interior hole, `line` is elongated, and
/// `dot` is neither.
enum class ContactType { dot, line, ring };

/// One convex piece of a contact region: the points over which f >= f_max - eps for one pair of triangles.
struct ContactPolygon {
  std::int32_t upper_triangle;  ///< triangle of the copy below
  std::int32_t lower_triangle;  ///< triangle of the copy above
  Points upper_points;          ///< k x 3, the polygon on the upper envelope, model units
  Points lower_points;          ///< k x 3, the same columns on the lower envelope
};

/// A connected set of contact polygons between one part of the copy below and one part of the copy above.
struct ContactRegion {
  ContactType type = ContactType::dot;  ///< type of the region, seen along r
  std::int32_t upper_part = -1;         ///< touched part of the copy below
  std::int32_t lower_part = -1;         ///< touching part of the copy above
  double area = 0;  ///< area of the union of the polygons seen along r, model units squared
  /// Area centroid on the upper envelope, model units; the mean of the points when the area is zero.
  Eigen::Vector3d upper_centre;
  Eigen::Vector3d lower_centre;          ///< the same on the lower envelope, before the lift
  Eigen::Vector3d long_axis;             ///< unit vector orthogonal to r: main direction of a line region
  std::vector<ContactPolygon> polygons;  ///< convex, one per pair of triangles; they may overlap
};

/// Definition of contact and thresholds of the region types.
struct ContactOptions {
  ContactSemantics semantics = ContactSemantics::solid;  ///< semantics of the separation
  double band = tolerance::contact_band;  ///< eps as a fraction of the extent h(M, r); in [0, 1]
  /// Smallest ratio of length to width of a line region.
  double line_aspect = 4;
  /// Smallest area of the hole of a ring, fraction of the area of the rectangle around the region.
  double min_hole = 0.01;
  /// Limit of the number of pairs of triangles that are examined one by one, plus eight per triangle of the
  /// shape. Coincident parts touch in quadratically many pairs.
  std::int64_t max_pairs = std::int64_t{1} << 16;
};

/// Contact regions of a shape and its copy.
struct Contacts {
  std::vector<ContactRegion> regions;  ///< largest area first, ties by position
  /// Whether the regions contain all touching pairs of triangles. Otherwise there are too many pairs
  /// (ContactOptions::max_pairs), and the regions contain each touching triangle with its deepest partner
  /// only. Of triangles with the same three points, the first one represents all. Areas are then lower
  /// bounds.
  bool complete = true;
  /// Touching parts, ascending, that no region names because their triangles coincide with those of other
  /// parts. Empty when `complete`.
  std::vector<std::int32_t> coincident_parts;
};

/// Input of `contact_regions`: a shape stacked on itself.
struct ContactQuery {
  const Shape& shape;          ///< M
  const SeparationTree& tree;  ///< tree of `shape`
  const Direction& direction;  ///< r, from the copy below to the copy above
  /// Separation of the shape from itself along r, in the semantics of the options.
  const Separation& separation;
};

/// Computes the contact regions { q : f(q) >= f_max - eps } of a shape stacked on itself along r. The regions
/// are polygons lifted to both surfaces, grouped into connected regions per pair of parts. Constructions in
/// double precision, within tolerance::relative of the diagonal. Throws UsageError for a band outside [0, 1].
Contacts contact_regions(const ContactQuery& query, const ContactOptions& options = {});

/// Computes the same for one use, from the shape and the direction alone; none where nothing is in the way
/// (Separation::blocked).
Contacts contact_regions(const Shape& shape, const Direction& direction, const ContactOptions& options = {});

/// How much of a copy lies close to the one below when they touch, seen along r.
struct CloseFit {
  double close_area = 0;      ///< area of the contact regions together, model units squared
  double projected_area = 0;  ///< area of the projection of the shape, model units squared
  /// As Contacts::complete; otherwise `close_area` is a lower bound.
  bool complete = true;

  /// Returns the close portion of the projection, in [0, 1]; 0 where the projection has no area.
  double share() const { return projected_area > 0 ? std::min(1.0, close_area / projected_area) : 0; }
};

/// Computes the areas that contact regions of a shape and the shape itself cover, seen along r. A layer of
/// thickness t between copies, such as one of a 3D print, is a contact band of t / h(M, r). Areas of up to
/// 4096 pairs of triangles, or triangles, are as accurate as `contact_regions`; those of more are measured
/// along scan lines, to about a thousandth of the rectangle around them. Precondition: `contacts` belong to
/// this shape and direction.
CloseFit close_fit(const Shape& shape, const Direction& direction, const Contacts& contacts);

}  // namespace stackabilization
