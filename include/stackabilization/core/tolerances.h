#pragma once

/// Accuracy of coordinates and bounds of shapes, for all modules. Each module has the tolerances of its own
/// in its folder. Predicates are exact and use none of them. These constants bound constructions in double
/// precision.
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

/// Bound of the coordinates of a shape, in any unit. Volumes, inertia and squares of areas then neither
/// overflow nor underflow.
inline constexpr double max_coordinate = 1e60;
/// Lower bound of the largest absolute coordinate of a shape, unless all coordinates are 0.
inline constexpr double min_shape_size = 1e-60;

}  // namespace stackabilization::tolerance
