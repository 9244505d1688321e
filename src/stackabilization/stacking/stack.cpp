#include "stackabilization/stacking/stack.h"

#include <algorithm>
#include <limits>

#include "stackabilization/shape/boxes.h"
#include "stackabilization/shape/errors.h"
#include "stackabilization/stacking/stack_boxes.h"

namespace stackabilization {

Line box_axis(const Shape& shape, const Direction& direction, BoxModel boxes) {
  const HullSupport hull(shape);
  const OrientedBox box =
      boxes == BoxModel::oriented ? hull.box_along(direction) : frame_box(hull.points(), direction);
  return {box.centre, direction};
}

StackResult stack_copies(const Shape& shape, const Direction& direction, const StackOptions& options) {
  StackPairs pairs(shape, direction, options);
  const StackBoxes boxes(shape, direction, options.boxes);
  return build_stack(pairs, pairs.sequence(), options.copies, boxes);
}

Shape stacked_shape(const Shape& shape, const Direction& direction, const StackResult& stack) {
  validate(shape);
  const auto copies = static_cast<Eigen::Index>(stack.copies.size());
  constexpr Eigen::Index most = std::numeric_limits<std::int32_t>::max();
  if (copies > 0 && std::max(shape.vertex_count(), shape.triangle_count()) > most / copies)
    throw UsageError("the stack as one shape would have more vertices or triangles than can be indexed");
  Shape all;
  all.unit = shape.unit;
  all.vertices.resize(copies * shape.vertex_count(), 3);
  all.triangles.resize(copies * shape.triangle_count(), 3);
  for (Eigen::Index k = 0; k < copies; ++k) {
    const StackedCopy& copy = stack.copies[static_cast<std::size_t>(k)];
    const Eigen::Vector3d lift = copy.offset.to_double() * direction.vector();
    const Shape moved = transformed(shape, copy.transform.rotation, copy.transform.translation + lift);
    const auto first_vertex = static_cast<std::int32_t>(k * shape.vertex_count());
    const auto first_part = static_cast<std::int32_t>(k * shape.part_count());
    all.vertices.middleRows(first_vertex, shape.vertex_count()) = moved.vertices;
    all.triangles.middleRows(k * shape.triangle_count(), shape.triangle_count()) =
        (shape.triangles.array() + first_vertex).matrix();
    for (const std::string& name : shape.part_names)
      all.part_names.push_back("copy" + std::to_string(k + 1) + "/" + name);
    for (const std::int32_t part : shape.triangle_part) all.triangle_part.push_back(first_part + part);
  }
  return all;
}

}  // namespace stackabilization
