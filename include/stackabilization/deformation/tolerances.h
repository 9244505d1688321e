#pragma once

/// Tolerances of edits, of the relations that they keep, and of the solvers that find them.
namespace stackabilization::tolerance {

/// A relation holds when its residual is at most this, fraction of the bounding-box diagonal.
inline constexpr double relation = 1e-6;

/// Slack of joints with Following::smooth, fraction of the bounding-box diagonal: half of the gap that a
/// joint may open to in a design (tolerance::quality::max_joints). A leg that a top and an apron hold could
/// not lean at all without it.
inline constexpr double joint_slack = 0.001;

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

/// Smallest factor by which a deformation may shrink a radius, a piece of a curve, the volume at a corner of
/// a cuboid, or the length and area of a feature curve. Smaller ones count as collapsed.
inline constexpr double collapse = 1e-3;

/// Smallest weight of an edge in as-rigid-as-possible deformation; its inverse is the largest weight.
/// Cotangents of ordinary triangles lie well within this range. Very thin triangles and pairs of obtuse
/// angles would make the system indefinite or ill-conditioned.
inline constexpr double edge_weight = 1e-3;

/// A part keeps its width across the axis of a taper if that is below this fraction of the width of the
/// shape.
inline constexpr double thin_in_taper = 0.15;

/// Distance below a slice at which a vertex still belongs to it, fraction of the height of the slice.
/// Rounding of coordinates and axis thus does not separate rings of vertices on the border of two slices.
inline constexpr double slice_slack = 1e-2;

}  // namespace stackabilization::tolerance
