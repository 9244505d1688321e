#include "stackabilization/core/copies.h"

#include <algorithm>
#include <limits>

#include "stackabilization/core/errors.h"

namespace stackabilization {

Shape as_one_shape(const Copies& copies) {
  for (const Shape& shape : copies.shapes) validate(shape);
  constexpr Eigen::Index most = std::numeric_limits<std::int32_t>::max();
  Eigen::Index vertices = 0, triangles = 0;
  for (const PlacedCopy& copy : copies.placed) {
    vertices += copies.shapes[copy.shape].vertex_count();
    triangles += copies.shapes[copy.shape].triangle_count();
    if (std::max(vertices, triangles) > most)
      throw UsageError("the copies as one shape would have more vertices or triangles than can be indexed");
  }
  Shape all;
  all.unit = copies.shapes.front().unit;
  all.vertices.resize(vertices, 3);
  all.triangles.resize(triangles, 3);
  vertices = triangles = 0;
  for (const PlacedCopy& copy : copies.placed) {
    const Shape& shape = copies.shapes[copy.shape];
    const auto first_part = static_cast<std::int32_t>(all.part_names.size());
    all.vertices.middleRows(vertices, shape.vertex_count()) =
        transformed(shape, copy.rotation, copy.translation).vertices;
    all.triangles.middleRows(triangles, shape.triangle_count()) =
        (shape.triangles.array() + static_cast<std::int32_t>(vertices)).matrix();
    vertices += shape.vertex_count();
    triangles += shape.triangle_count();
    for (const std::string& name : shape.part_names) all.part_names.push_back(copy.name + "/" + name);
    for (const std::int32_t part : shape.triangle_part) all.triangle_part.push_back(first_part + part);
  }
  validate(all);
  return all;
}

}  // namespace stackabilization
