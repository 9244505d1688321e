#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "stackabilization/deformation/deformation_model.h"

namespace stackabilization {

// DeformationConstraints for models that move vertices, not primitives. Vertices that no triangle uses are
// ignored.

/// Returns the ascending rows of the vertices of `rest` that `constraints` fix:
///
/// * the vertices of the fixed parts;
/// * for each fixed point, the corners of the triangle that contains the nearest point of the surface (the
///   two ends of an edge, or the one corner, when the nearest point lies there);
/// * every vertex with the coordinates of one of these.
///
/// Throws UsageError under the conditions of `validate(constraints, rest)`, and InputError when points are
/// fixed on a shape without area.
std::vector<std::int32_t> fixed_vertices(const Shape& rest, const DeformationConstraints& constraints);

/// Changes the vertices of a deformed shape as little as necessary to satisfy `constraints`. `vertices`: n x
/// 3, rows as in `rest`, model units. `fixed`: the result of fixed_vertices.
///
/// * The extent along r is restored by a displacement along r that is a linear function of the height along
///   r. The lowest or the highest point stays when it is at its height at rest. With fixed vertices the
///   displacement is zero between their heights, and linear above and below them. Vertices of equal
///   coordinates stay equal.
/// * Fixed vertices and the box are checked.
///
/// Refuses when a fixed vertex has moved, the box has changed too much, a vertex is not finite, the shape is
/// flat along r, or the fixed vertices leave no room for the extent. Extent and box hold up to rounding,
/// fixed vertices exactly. Throws UsageError under the conditions of `validate(constraints, rest)`.
MovedVertices constrain(const Shape& rest, Points vertices, const DeformationConstraints& constraints,
                        const std::vector<std::int32_t>& fixed);

}  // namespace stackabilization
