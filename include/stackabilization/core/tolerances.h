#pragma once

/// All small literals of this library. Predicates are exact and use none of them. These constants bound
/// constructions in double precision and choose defaults of options.
namespace stackabilization::tolerance {

/// Relative accuracy of constructions in double precision (boxes, areas, centres), fraction of the
/// bounding-box diagonal. It is more than six decades above the rounding of coordinates near the origin, and
/// more than two decades above it for coordinates 1e4 diagonals away.
inline constexpr double relative = 1e-9;

/// Rounding allowance of constructions in double precision, fraction of the largest coordinate. Two hull
/// triangles with all corners within it of one plane are one face. Two points closer than it are one corner
/// of a polygon.
inline constexpr double rounding = 1e-13;

/// Generous bound of the rounding error of p . r or of a planar area, fraction of the sum of the magnitudes
/// of its products: 16 units in the last place.
inline constexpr double product_rounding = 0x1p-48;

/// Smallest weight of an edge in as-rigid-as-possible deformation; its inverse is the largest weight.
/// Cotangents of ordinary triangles lie well within this range. Very thin triangles and pairs of obtuse
/// angles would make the system indefinite or ill-conditioned.
inline constexpr double edge_weight = 1e-3;

/// Distance below a slice at which a vertex still belongs to it, fraction of the height of the slice.
/// Rounding of coordinates and axis thus does not separate rings of vertices on the border of two slices.
inline constexpr double slice_slack = 1e-2;

/// Default width of the contact band { f >= f_max - eps }, fraction of the extent h along the direction. It
/// is wide enough to connect the ring of a cup modelled with facets, and narrow enough to exclude second
/// contacts.
inline constexpr double contact_band = 0.0125;

/// Width at which the enclosure of a separation is not refined further, fraction of the extent of the shapes
/// along the file axis next to the direction.
inline constexpr double enclosure_width = 1e-12;

/// Distance above and below an exact f_max at which a collision test must be free and colliding, fraction of
/// the extent h.
inline constexpr double collision_margin = 1e-9;

/// Error of a sampled f_max above which a report explains it, fraction of the extent h.
inline constexpr double sampling_error = 1e-3;

/// Angular step at which a local direction search stops, radians. Such a step changes S by at most about
/// 1e-8.
inline constexpr double direction_step = 1e-8;

/// Two directions whose S differ by less than this are equally good; smaller differences are rounding.
inline constexpr double stackability = 1e-11;

/// Bound of the coordinates of a shape, in any unit. Volumes, inertia and squares of areas then neither
/// overflow nor underflow.
inline constexpr double max_coordinate = 1e60;
/// Lower bound of the largest absolute coordinate of a shape, unless all coordinates are 0.
inline constexpr double min_shape_size = 1e-60;

/// Height of the slab at the bottom of a shape whose points `inspect` regards as its support, fraction of the
/// extent.
inline constexpr double support_slab = 1e-2;

/// `inspect` names an up axis only when the score of every other axis is below this fraction of its score.
inline constexpr double clear_lead = 0.9;

/// Smallest thickness of a cuboid, fraction of its diagonal. Thinner cuboids are thickened to it, because
/// mean value coordinates are undefined in a cage without volume.
inline constexpr double min_thickness = 1e-3;

/// Two symmetries are meant to be the same when they map a part to places nearer than this, fraction of the
/// bounding-box diagonal of the shape. Two planes are meant to meet at a simple angle when they do so within
/// this many radians.
inline constexpr double same_symmetry = 0.01;

/// Axes of symmetries within this angle, in radians, of an axis or a main plane of the file are meant to lie
/// in it. It is fifty times the error of a fit to a mesh with 1e-5 noise, and a tenth of a visible angle.
inline constexpr double file_axis = 1e-3;

/// Accuracy of symmetries of symmetrized primitives, fraction of the diagonal or of the largest coordinate,
/// whichever is larger. It is ten million times smaller than the accuracy promised for edits, and ten times
/// larger than rounding errors.
inline constexpr double symmetrized = 1e-13;

/// Rounding step of the centres and axes of boxes in project files, fraction of a power of two above their
/// largest coordinate. It is 16 times the rounding of the computation, so that writing, reading and writing
/// again gives the same text.
inline constexpr double project_grid = 0x1p-48;

/// A relation holds when its residual is at most this, fraction of the bounding-box diagonal.
inline constexpr double relation = 1e-6;

/// Residual at which the constraints of a deformation count as solved, fraction of the bounding-box diagonal.
/// It is far below `relation` and above the rounding of coordinates.
inline constexpr double solve = 1e-12;

/// A constraint is redundant when its share of the normal equations is below this fraction of the largest
/// share. Examples are the symmetric copy of a joint, and a joint between parts that move as one.
inline constexpr double redundant = 1e-10;

/// Step of forward differences, relative to the size of the variable: near the square root of the unit
/// roundoff, where truncation and rounding errors balance.
inline constexpr double difference_step = 0x1p-24;

/// Eigenvalues below this belong to the null space of a sum of (G - 1)^T (G - 1) over isometries G of finite
/// order. The other eigenvalues are at least 4 sin^2(pi / order), which is far larger.
inline constexpr double invariance = 1e-6;

/// A search identifies two designs when their controls differ by less than this, fraction of the diagonal. It
/// is far above the rounding of edits in another order, and far below any step.
inline constexpr double same_design = 1e-6;

/// Largest amount by which S of a refined design may exceed its target, when its distortion depends on it.
inline constexpr double target = 1e-7;

/// Relative accuracy at which magnitudes of edits, and the distortion that they cause, count as converged.
inline constexpr double magnitude = 1e-6;

/// Smallest factor by which a deformation may shrink a radius, a piece of a curve, the volume at a corner of
/// a cuboid, or the length and area of a feature curve. Smaller ones count as collapsed.
inline constexpr double collapse = 1e-3;

}  // namespace stackabilization::tolerance
