#pragma once

#include <numbers>

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

/// Default of the largest distance across a direction at which walls of two copies are tight, fraction of the
/// diagonal: 0.3 mm on a crate of 0.3 m.
inline constexpr double side_gap = 1e-3;

/// Forces and torques at contacts that count as none, in weights of the body: rounding of points and normals.
inline constexpr double force = 1e-10;
/// Coefficients of friction, and shares of a force that friction resists, that count as none.
inline constexpr double friction = 1e-9;
/// Largest amount by which the tangent of a tipping angle with friction is too small, fraction of it;
/// friction cones that are pyramids make it as small again.
inline constexpr double tilt = 2e-3;
/// Largest error of the least friction that a stack needs, fraction of it.
inline constexpr double needed_friction = 1e-6;

/// Largest slope of a wall against a direction. The projection of a wall is too narrow to be divided.
inline constexpr double wall_slope = 1e-5;

/// Angle between a stacking direction and up, the z axis, to which an object still stands in its stack,
/// radians: 30 degrees.
inline constexpr double max_stack_lean = std::numbers::pi / 6;

}  // namespace stackabilization::tolerance
