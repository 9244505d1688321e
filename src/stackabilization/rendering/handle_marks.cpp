#include "stackabilization/rendering/handle_marks.h"

#include <array>
#include <utility>

#include "stackabilization/rendering/structure_scene.h"

namespace stackabilization::detail {

namespace {

constexpr double handle_width = 3;  ///< pixels

Points closed(Points points) {
  points.conservativeResize(points.rows() + 1, Eigen::NoChange);
  points.bottomRows(1) = points.topRows(1);
  return points;
}

}  // namespace

std::vector<Points> handle_lines(const Handle& handle, const Shape& shape,
                                 const std::vector<Primitive>& primitives) {
  const auto index = static_cast<Eigen::Index>(handle.index);
  if (handle.kind == HandleKind::shape) return outline(cuboid_of(axis_aligned_box(shape.vertices)));
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
    return {section_circle(*cylinder, index)};
  return {};
}

Scene edited_scene(const Shape& shape, const Colour& colour, const std::vector<Handle>& handles) {
  SceneMesh mesh{shape, std::vector<Colour>(shape.part_names.size(), colour)};
  for (const Handle& handle : handles)
    if (handle.kind == HandleKind::part)
      mesh.colours.at(static_cast<std::size_t>(handle.part)) = mix(colour, palette::contact, 0.8);
  Scene scene;
  scene.add(std::move(mesh));
  return scene;
}

Elements handle_marks(const std::vector<Points>& lines, const View& view, const Rectangle& place) {
  Elements elements;
  for (const Points& line : lines) {
    PlanePoints points(line.rows(), 2);
    for (Eigen::Index i = 0; i < line.rows(); ++i)
      points.row(i) = (Eigen::Vector2d(place.x, place.y) + view.project(line.row(i).transpose())).transpose();
    if (points.rows() == 1)
      elements.emplace_back(
          FilledPolygon{circle(points.row(0).transpose(), 2 * handle_width), palette::contact});
    else
      elements.emplace_back(Polyline{std::move(points), palette::contact, handle_width});
  }
  return elements;
}

}  // namespace stackabilization::detail
