#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "stackabilization/deformation/deformation_model.h"

namespace stackabilization {

// What models that move plain vertices need of DeformationConstraints. Vertices that no triangle uses count
// nowhere.

/// Ascending rows of the vertices of `rest` that `constraints` fix: those of the fixed parts; for each fixed
/// point the corners of the triangle that its nearest point of the surface lies on (the two of the edge, the
/// one corner, where it lies there); and every vertex with the coordinates of one of these. Throws UsageError
/// as `validate(constraints, rest)` does, InputError when points are to be fixed on a shape without area.
std::vector<std::int32_t> fixed_vertices(const Shape& rest, const DeformationConstraints& constraints);

/// Vertices that satisfy constraints, or why there are none.
struct ConstrainedVertices {
  std::optional<Refusal> refusal;  ///< when set, `vertices` are those at rest
  Points vertices;                 ///< n x 3, model units
};

/// `vertices` of a deformed shape (n x 3, rows as in `rest`), changed as little as it takes to satisfy
/// `constraints`:
///
/// * the extent along r is restored by a displacement along r that is linear in the height over r, and keeps
/// the lowest or
///   the highest point where either is where it was; with fixed vertices it is zero between the heights of
///   these, and linear above and below them. Vertices of equal coordinates stay equal;
/// * fixed vertices (`fixed`, as fixed_vertices gives them) and the box are checked.
///
/// Refuses when a fixed vertex has moved, the box has changed too much, a vertex is not finite, or fixed
/// vertices leave the extent no room. Extent and box hold up to rounding, fixed vertices exactly. Throws
/// UsageError as `validate(constraints, rest)` does.
ConstrainedVertices constrained(const Shape& rest, Points vertices, const DeformationConstraints& constraints,
                                const std::vector<std::int32_t>& fixed);

}  // namespace stackabilization
