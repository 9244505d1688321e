#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "stackabilization/shape/shape.h"

/// Not installed.
namespace stackabilization::detail {

/// The vertices of a shape, those of equal coordinates merged into one place.
struct MergedPlaces {
  std::vector<Eigen::Vector3d> points;  ///< one per place, in order of first appearance
  std::vector<std::int32_t> of_vertex;  ///< place of every row of Shape::vertices; -1 where not finite
  std::vector<std::int32_t> vertex_of;  ///< first row at every place
  std::vector<std::array<int, 3>>
      triangles;  ///< the triangles of the shape by places, also those that collapse
};

/// Precondition: `validate(shape)`.
MergedPlaces merged_places(const Shape& shape);

}  // namespace stackabilization::detail
