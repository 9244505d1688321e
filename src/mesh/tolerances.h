#pragma once

/// Tolerances of meshes and hulls that their sources alone use.
namespace stackabilization::tolerance {

/// Thickness below which a set has no silhouette that the normals of its hull define, fraction of the largest
/// coordinate: those of its narrow faces have lost half of the digits or more.
inline constexpr double hull_silhouette = 1e-6;

/// Depth from which on a point is inside of a hull, where the box of all points is [-1, 1]^3: a hundred times
/// the rounding of single precision.
inline constexpr float inside_hull = 3e-5F;

}  // namespace stackabilization::tolerance
