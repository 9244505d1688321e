#include "stackabilization/rendering/handle_lines.h"

#include <array>

#include "rendering/scene/structure_scene.h"
#include "stackabilization/mesh/boxes.h"

namespace stackabilization {

namespace {

Points closed(Points points) {
  points.conservativeResize(points.rows() + 1, Eigen::NoChange);
  points.bottomRows(1) = points.topRows(1);
  return points;
}

}  // namespace

std::vector<Points> handle_lines(const Handle& handle, const Shape& shape,
                                 const std::vector<Primitive>& primitives) {
  const auto index = static_cast<Eigen::Index>(handle.index);
  if (handle.kind == HandleKind::shape) return detail::outline(cuboid_of(axis_aligned_box(shape.vertices)));
  if (handle.kind == HandleKind::point && index < shape.vertex_count()) return {shape.vertices.row(index)};
  if (static_cast<std::size_t>(handle.part) >= primitives.size()) return {};
  const Primitive& primitive = primitives[static_cast<std::size_t>(handle.part)];
  const auto* const cuboid = std::get_if<Cuboid>(&primitive);
  const auto* const cylinder = std::get_if<GeneralizedCylinder>(&primitive);
  if (handle.kind == HandleKind::corner && cuboid != nullptr && index < 8)
    return {cuboid->corners.row(index)};
  if (handle.kind == HandleKind::face && cuboid != nullptr && index < 6) {
    const std::array<int, 4> ring = cuboid_face(handle.index);
    return {closed(cuboid->corners(ring, Eigen::all))};
  }
  if (handle.kind == HandleKind::section && cylinder != nullptr && index < cylinder->centres.rows())
    return {detail::section_circle(*cylinder, index)};
  return {};
}

}  // namespace stackabilization
