#pragma once

/// Tolerances of stackability, of the search for a direction and of the checks of f_max.
namespace stackabilization::tolerance {

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

/// Default of the largest difference between the best S and a bound of S over all directions.
inline constexpr double direction_bound = 1e-3;

/// Radius of the cells of directions that are not cut any more, radians: a cell that small which no pair of
/// triangles covers stays open.
inline constexpr double direction_cell = 1e-7;

/// Default of the largest difference between the height of a place and its bound, fraction of the extent of
/// the higher one of the two shapes along the direction.
inline constexpr double place_height = 0x1p-10;
/// The same for a mean gap, and for the mean depth of the space below a shape: integrals, whose ranges take
/// many times the work.
inline constexpr double place_gap = 0x1p-6;

/// Distance from a surface at which a point is beside it, fraction of the diagonal of the shape.
inline constexpr double beside_surface = 1e-7;

/// Largest slope of a wall against a direction. The projection of a wall is too narrow to be divided.
inline constexpr double wall_slope = 1e-5;

}  // namespace stackabilization::tolerance
