#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "stackabilization/core/tolerances.h"
#include "stackabilization/envelope/separation.h"

namespace stackabilization {

/// Shape of a contact region (section 4.2 of the paper): `ring` has an interior hole, `line` is elongated,
/// else `dot`.
enum class ContactType { dot, line, ring };

/// One convex piece of a contact region: the points over which f >= f_max - eps for one pair of triangles.
struct ContactPolygon {
  std::int32_t upper_triangle;  ///< triangle of the copy below
  std::int32_t lower_triangle;  ///< triangle of the copy above
  Points upper_points;          ///< k x 3, the polygon on the upper envelope, model units
  Points lower_points;          ///< k x 3, the same columns on the lower envelope
};

/// A connected set of contact polygons with one part on each side.
struct ContactRegion {
  ContactType type = ContactType::dot;  ///< its shape seen along r
  std::int32_t upper_part = -1;         ///< part of the copy below that is touched
  std::int32_t lower_part = -1;         ///< part of the copy above that touches it
  double area = 0;  ///< area of the union of the polygons seen along r, model units squared
  Eigen::Vector3d
      upper_centre;  ///< area centroid on the upper envelope (mean of the points where the area is zero)
  Eigen::Vector3d lower_centre;          ///< the same on the lower envelope, before the lift
  Eigen::Vector3d long_axis;             ///< unit vector orthogonal to r: primary direction of a line region
  std::vector<ContactPolygon> polygons;  ///< convex, one per pair of triangles; they may overlap
};

/// What `contact_regions` counts as contact, and how it names the shapes of regions.
struct ContactOptions {
  ContactSemantics semantics = ContactSemantics::solid;  ///< that of the separation
  double band = tolerance::contact_band;  ///< eps as a fraction of the extent h(M, r); in [0, 1]
  double line_aspect = 4;                 ///< a region at least this many times longer than wide is a line
  double min_hole = 0.01;  ///< a ring's hole takes at least this share of the rectangle around the region
  /// Pairs of triangles that are looked at one by one: at most this many, and eight more per triangle of the
  /// shape. Coincident parts touch each other in quadratically many.
  std::int64_t max_pairs = std::int64_t{1} << 16;
};

/// Where a shape touches its copy.
struct Contacts {
  std::vector<ContactRegion> regions;  ///< largest area first, ties by position
  /// All pairs of triangles that touch are in the regions. If not, because they are too many
  /// (ContactOptions::max_pairs), each triangle that touches is there with its deepest partner alone, of
  /// triangles with the same three points the first for all: areas are lower bounds then.
  bool complete = true;
  /// Parts, ascending, that touch but are named by no region, because their triangles coincide with those of
  /// parts that are. None where `complete`.
  std::vector<std::int32_t> coincident_parts;
};

/// A shape stacked on itself.
struct ContactQuery {
  const Shape& shape;            ///< M
  const SeparationTree& tree;    ///< of `shape`
  const Direction& direction;    ///< r, from the copy below to the copy above
  const Separation& separation;  ///< the answer for the three, in the semantics of the options
};

/// The contact regions { q : f(q) >= f_max - eps } of a shape stacked on itself along r, as
/// polygons lifted to both surfaces, grouped into connected regions per pair of parts. Constructions in
/// double precision, within tolerance::relative of the diagonal. Throws UsageError for a band outside [0, 1].
Contacts contact_regions(const ContactQuery& query, const ContactOptions& options = {});

}  // namespace stackabilization
