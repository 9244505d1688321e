#include "stackabilization/core/copies.h"

#include <algorithm>
#include <limits>

#include "stackabilization/core/errors.h"

namespace stackabilization {

Shape as_one_shape(const Copies& copies) {
  const Shape& shape = copies.shape;
  validate(shape);
  const auto count = static_cast<Eigen::Index>(copies.placed.size());
  constexpr Eigen::Index most = std::numeric_limits<std::int32_t>::max();
  if (count > 0 && std::max(shape.vertex_count(), shape.triangle_count()) > most / count)
    throw UsageError("the copies as one shape would have more vertices or triangles than can be indexed");
  Shape all;
  all.unit = shape.unit;
  all.vertices.resize(count * shape.vertex_count(), 3);
  all.triangles.resize(count * shape.triangle_count(), 3);
  for (Eigen::Index k = 0; k < count; ++k) {
    const PlacedCopy& copy = copies.placed[static_cast<std::size_t>(k)];
    const auto first_vertex = static_cast<std::int32_t>(k * shape.vertex_count());
    const auto first_part = static_cast<std::int32_t>(k * shape.part_count());
    all.vertices.middleRows(first_vertex, shape.vertex_count()) =
        transformed(shape, copy.rotation, copy.translation).vertices;
    all.triangles.middleRows(k * shape.triangle_count(), shape.triangle_count()) =
        (shape.triangles.array() + first_vertex).matrix();
    for (const std::string& name : shape.part_names) all.part_names.push_back(copy.name + "/" + name);
    for (const std::int32_t part : shape.triangle_part) all.triangle_part.push_back(first_part + part);
  }
  validate(all);
  return all;
}

}  // namespace stackabilization
