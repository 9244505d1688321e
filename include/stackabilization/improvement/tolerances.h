#pragma once

#include <cstddef>
#include <numbers>

/// Tolerances of the search for designs and of their refinement.
namespace stackabilization::tolerance {

/// Displacement from which on a person sees a change, fraction of the diagonal.
inline constexpr double visible = 0.001;

/// A search identifies two designs when their controls differ by less than this, fraction of the diagonal. It
/// is far above the rounding of edits in another order, and far below any step.
inline constexpr double same_design = 1e-6;

/// Largest amount by which S of a refined design may exceed its target, when its distortion depends on it.
inline constexpr double target = 1e-7;

/// Relative accuracy at which magnitudes of edits, and the distortion that they cause, count as converged.
inline constexpr double magnitude = 1e-6;

/// Length of the moves across the direction after which two pieces still overlap where they keep copies apart
/// for good (closed_pair), fraction of the diagonal.
inline constexpr double closed_move = 0.12;
/// Scalings after which such pieces still overlap: of one by 1 minus this, of the other by the inverse.
inline constexpr double closed_scale = 0.2;
/// Depth to which such pieces reach into the shape, fraction of the height.
inline constexpr double closed_depth = 0.06;
/// Largest number of pieces at each end that are looked at.
inline constexpr std::size_t closed_pieces = 40;

}  // namespace stackabilization::tolerance

/// Small literals of measuring the quality of a design. docs/quality.md gives the reasons for the limits.
namespace stackabilization::tolerance::quality {

/// Extent of points along an axis below which they are flat along it, fraction of their longest extent.
inline constexpr double flat = 1e-4;

/// Ratio of the second moments of a cross-section, as a ratio of widths, from which on it is round.
inline constexpr double round = 0.95;

/// Angle between triangles of one flat face, and between parallel faces at rest, radians: one degree.
inline constexpr double coplanar = 0.0175;

/// Angle between neighbouring triangles below which a surface is smooth there, radians: 30 degrees.
inline constexpr double smooth_fold = std::numbers::pi / 6;

/// Change of that angle from which on there is a crease, radians: 15 degrees.
inline constexpr double slight_crease = std::numbers::pi / 12;

/// Change of that angle from which on a crease counts in full, radians: 25 degrees.
inline constexpr double full_crease = 5 * std::numbers::pi / 36;

/// Height of a triangle over a side below which its plane is mostly rounding there, fraction of the diagonal.
inline constexpr double needle = 1e-4;
/// The same, where the height is also below `slender` of the side: what such a sliver does on its own is not
/// seen, but that of the surface around it.
inline constexpr double sliver = 0.003;
/// Ratio of the height of a sliver to the side, at most.
inline constexpr double slender = 0.1;

/// Distance at which parts, and triangles of one part, touch at rest, fraction of the diagonal.
inline constexpr double touching = 0.002;

/// Distance up to which two symmetry planes are the same, fraction of the diagonal.
inline constexpr double same_plane = 0.01;

/// Share of the area of a part that a flat face has at least.
inline constexpr double face_share = 0.04;

/// Share of the footprint of the object that a seat or table top has at least.
inline constexpr double seat_share = 0.1;

/// Ratio of length to width from which on a cuboid is elongated.
inline constexpr double elongated = 3;

/// Largest ratio of width to thickness of a bar: an elongated cuboid that is wider is a board or a slat,
/// which may be a seat.
inline constexpr double bar_width = 2;

/// Height of a seat above the ground, at least, fraction of the height.
inline constexpr double seat_height = 0.05;

/// Height of the slab at the bottom whose vertices are feet, fraction of the height.
inline constexpr double foot_slab = 0.01;

/// Lean of a leg or post at rest, at most, radians: what leans more is a brace or a rung.
inline constexpr double max_lean_of_leg = std::numbers::pi / 4;
/// Lean of a leg or post that nobody minds, degrees.
inline constexpr double free_lean = 15;

/// Diagonal of a small part, at most, fraction of the diagonal of the object.
inline constexpr double small_part = 0.08;

// Default limits, in the order of QualityMeasure.
inline constexpr double max_self_intersection = 0;  ///< default limit, pairs of triangles
inline constexpr double max_collision = 0;          ///< default limit, pairs of parts
inline constexpr double max_piercing = 0.005;       ///< default limit, of the diagonal
inline constexpr double max_joints = 0.002;         ///< default limit, of the diagonal
inline constexpr double max_symmetry = 0.002;       ///< default limit, of the diagonal
inline constexpr double max_creases = 0.05;         ///< default limit, of the diagonal
inline constexpr double max_straightness = 0.005;   ///< default limit, of the length
inline constexpr double max_bending = 10;           ///< default limit, degrees
inline constexpr double max_section = 0.06;         ///< default limit, of the width
inline constexpr double max_profile = 0.04;         ///< default limit, of the radius
inline constexpr double max_flatness = 0.005;       ///< default limit, of the width
inline constexpr double max_parallelism = 2;        ///< default limit, degrees
inline constexpr double min_size = 0.8;             ///< default limit, of rest
inline constexpr double min_small_part = 0.95;      ///< default limit, of rest
inline constexpr double min_thickness = 0.9;        ///< default limit, of rest
inline constexpr double max_lean = 15;              ///< default limit, degrees
inline constexpr double min_seat = 0.9;             ///< default limit, of rest
inline constexpr double max_tilt = 2;               ///< default limit, degrees
inline constexpr double max_height = 0.001;         ///< default limit, of the height
inline constexpr double max_feet = 0.002;           ///< default limit, of the diagonal

}  // namespace stackabilization::tolerance::quality

/// Small literals of the description of a change in words.
namespace stackabilization::tolerance::explanation {

/// Change of a size that is named even where it moves the surface less, as of thin bars.
inline constexpr double ratio = 0.015;

/// Ratios of two sizes that differ by less than this share of the larger change are one.
inline constexpr double alike = 0.1;

/// Slope that level planes or upright lines may get beside a shear; more is a rotation.
inline constexpr double level = 0.02;

/// Least advantage of a shear over a rotation, in logarithms of stretches.
inline constexpr double same_split = 1e-9;

/// Distance from the upright axis within which a part is on it, fraction of the diagonal.
inline constexpr double on_axis = 0.03;

/// Height of the lower end of a member that stands on the ground, at most, fraction of the height.
inline constexpr double standing = 0.15;

}  // namespace stackabilization::tolerance::explanation
