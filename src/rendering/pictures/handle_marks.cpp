#include "rendering/pictures/handle_marks.h"

#include <utility>

namespace stackabilization::detail {

namespace {

constexpr double handle_width = 3;  ///< pixels

}  // namespace

Scene edited_scene(const Shape& shape, const Colour& colour, const std::vector<Handle>& handles) {
  SceneMesh mesh{shape, std::vector<Colour>(shape.part_names.size(), colour)};
  for (const Handle& handle : handles)
    if (handle.kind == HandleKind::part)
      mesh.colours.at(static_cast<std::size_t>(handle.part)) = mix(colour, palette::contact, 0.8);
  Scene scene;
  scene.add(std::move(mesh));
  return scene;
}

std::vector<Points> lines_of(const std::vector<Handle>& handles, const Shape& shape,
                             const std::vector<Primitive>& primitives) {
  std::vector<Points> lines;
  for (const Handle& handle : handles)
    for (Points& line : handle_lines(handle, shape, primitives)) lines.push_back(std::move(line));
  return lines;
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
