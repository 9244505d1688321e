#pragma once

/// Tolerances of meshes and hulls that their sources alone use.
namespace stackabilization::tolerance {

/// Thickness below which a set has no silhouette that the normals of its hull define, fraction of the largest
/// coordinate: those of its narrow faces have lost half of the digits or more.
inline constexpr double hull_silhouette = 1e-6;

}  // namespace stackabilization::tolerance
