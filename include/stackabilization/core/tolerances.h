#pragma once

/// The only place of this library with small literals. Predicates are exact and use none of them; these bound
/// constructions in double precision and choose defaults of options.
namespace stackabilization::tolerance {

/// Relative accuracy demanded of constructions in double precision (boxes, areas, centres), as a fraction of
/// the bounding-box diagonal. It sits more than six decades above the rounding of coordinates near the
/// origin, and more than two for coordinates 1e4 diagonals away.
inline constexpr double relative = 1e-9;

/// Rounding allowance of constructions in double precision, as a fraction of the largest coordinate: two hull
/// triangles whose corners lie within it of one plane are one face, and points closer than it are one corner
/// of a polygon.
inline constexpr double rounding = 1e-13;

/// Bound, several times over, of the rounding of p . r or of a planar area, as a fraction of the sum of the
/// magnitudes of its products: 16 units in the last place.
inline constexpr double product_rounding = 0x1p-48;

/// Least weight of an edge in as-rigid-as-possible deformation, and one over the greatest. Cotangents of
/// ordinary triangles lie well within; needles and obtuse pairs would make the system indefinite or useless.
inline constexpr double edge_weight = 1e-3;

/// Fraction of a slice's height by which a vertex may lie below it and still be counted in: rings of vertices
/// on the border of two slices are not torn apart by the rounding of coordinates and axis.
inline constexpr double slice_slack = 1e-2;

/// Default width of the contact band { f >= f_max - eps }, as a fraction of the extent h along the direction:
/// wide enough that the ring of a cup modelled with facets hangs together, narrow enough that second contacts
/// stay out.
inline constexpr double contact_band = 0.0125;

/// Width at which a certified enclosure of a separation stops tightening, as a fraction of the extent of the
/// shapes along the file axis next to the direction.
inline constexpr double enclosure_width = 1e-12;

/// How far above and below an exact f_max a collision test must be free and colliding, as a fraction of the
/// extent h.
inline constexpr double collision_margin = 1e-9;

/// Error of a sampled f_max, as a fraction of the extent h, from which on a reader deserves an explanation.
inline constexpr double sampling_error = 1e-3;

/// Angular step, in radians, at which a local direction search stops: moving by it changes S by about 1e-8 at
/// most.
inline constexpr double direction_step = 1e-8;

/// Two directions whose S differ by less are equally good: below it lies rounding.
inline constexpr double stackability = 1e-11;

/// Coordinates of a shape lie within these, in any unit, so that volumes, inertia and squares of areas
/// neither overflow nor underflow.
inline constexpr double max_coordinate = 1e60;
inline constexpr double min_shape_size = 1e-60;  ///< of the largest coordinate, unless all are 0

/// Height, as a fraction of the extent, of the slab whose points `inspect` takes as what a shape stands on.
inline constexpr double support_slab = 1e-2;

/// `inspect` names an up axis only when every other axis fits less than this fraction as well.
inline constexpr double clear_lead = 0.9;

/// Least thickness of a cuboid, as a fraction of its diagonal: thinner ones are thickened to it, for mean
/// value coordinates in a cage without volume are undefined.
inline constexpr double min_thickness = 1e-3;

/// Symmetries that take the same part to places nearer than this, as a fraction of the bounding-box diagonal
/// of the shape, or whose planes meet within this many radians of a simple angle, are meant to be one, or to
/// meet at that angle.
inline constexpr double same_symmetry = 0.01;

/// Axes of symmetries that miss an axis or a main plane of the file by less than this, in radians, are meant
/// to lie in it: fifty times what fitting to a mesh of 1e-5 noise misses, and a tenth of what the eye sees.
inline constexpr double file_axis = 1e-3;

/// How exactly primitives satisfy symmetries after they were made symmetric, as a fraction of the diagonal or
/// of the largest coordinate, whichever is larger: ten million times below what is promised for edits, 10
/// times above what rounding leaves.
inline constexpr double symmetrized = 1e-13;

/// Step to which project files round the centres and axes of boxes, as a fraction of a power of two above
/// their largest coordinate: 16 times the rounding of what they are computed from, so that writing, reading
/// and writing again gives the same text.
inline constexpr double project_grid = 0x1p-48;

/// A relation holds when it is off by no more than this, as a fraction of the bounding-box diagonal.
inline constexpr double relation = 1e-6;

/// Constraints of a deformation are solved until they are off by no more than this, as a fraction of the
/// bounding-box diagonal: far below what `relation` demands, still above the rounding of coordinates.
inline constexpr double solve = 1e-12;

/// A constraint whose share of the normal equations is below this fraction of the largest repeats others:
/// the symmetric copy of a joint, a joint between parts that move as one.
inline constexpr double redundant = 1e-10;

/// Step of forward differences, relative to the size of what is varied: near the square root of the unit
/// roundoff, where truncation and rounding balance.
inline constexpr double difference_step = 0x1p-24;

/// Eigenvalues below this belong to the null space of a sum of (G - 1)^T (G - 1) over isometries G of finite
/// order; the others are at least 4 sin^2(pi / order), far above.
inline constexpr double invariance = 1e-6;

/// Two designs are the same to a search when their controls differ by less than this, as a fraction of the
/// diagonal: far above what rounding makes of edits in another order, far below any step.
inline constexpr double same_design = 1e-6;

/// By how much S of a refined design may exceed its target, where its distortion depends on it.
inline constexpr double target = 1e-7;

/// Relative accuracy at which magnitudes of edits, and the distortion that they cause, count as settled.
inline constexpr double magnitude = 1e-6;

/// Smallest factor by which a deformation may shrink a radius, a piece of a curve, the volume at a corner of
/// a cuboid, or length and area of a feature curve: what is smaller has collapsed.
inline constexpr double collapse = 1e-3;

}  // namespace stackabilization::tolerance
