#pragma once

#include <cstdint>
#include <vector>

#include "mesh/surface_index.h"
#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// The different points among the vertices that triangles use, in order of first use. Formats repeat
/// vertices; deformations that move places instead keep equal vertices equal and know which triangles hang
/// together.
struct Places {
  Points points;                        ///< k x 3, model units
  std::vector<std::int32_t> of_vertex;  ///< per vertex its row of `points`; -1 where no triangle uses it
  std::vector<std::int32_t> vertex;     ///< per place the first vertex there, in order of the triangles
  Triangles triangles;                  ///< m x 3 rows of `points`, triangle by triangle as in the shape

  /// Of triangle `triangle`, model units squared.
  double area(Eigen::Index triangle) const;
};

/// Precondition: `validate(shape)`.
Places places_of(const Shape& shape);

/// Weights, summing to one, of the corners of `at.triangle` in `at.point`. Up to rounding within [0, 1].
Eigen::Vector3d corner_weights(const Shape& shape, const SurfacePoint& at);

}  // namespace stackabilization::detail
