#include <algorithm>
#include <array>
#include <utility>

#include "stackabilization/rendering/legend.h"
#include "stackabilization/rendering/pictures.h"
#include "stackabilization/rendering/plot_parts.h"
#include "stackabilization/rendering/structure_scene.h"
#include "stackabilization/shape/errors.h"

namespace stackabilization {
namespace {

using detail::LegendMark;

constexpr double handle_width = 3;  ///< pixels

Points closed(Points points) {
  points.conservativeResize(points.rows() + 1, Eigen::NoChange);
  points.bottomRows(1) = points.topRows(1);
  return points;
}

struct Side {
  const Shape& shape;
  const std::vector<Primitive>& primitives;
  Colour colour;
  std::string caption;
};

/// What was edited.
struct Edited {
  const std::vector<Handle>& handles;
  const std::vector<std::vector<std::int32_t>>& curves;
};

/// Lines that show a handle; empty for parts, which are coloured, and for what is not known here, such as
/// wires.
std::vector<Points> handle_lines(const Handle& handle, const Side& side) {
  const Shape& shape = side.shape;
  const std::vector<Primitive>& primitives = side.primitives;
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

std::vector<Points> lines_of(const Edited& edited, const Side& side) {
  std::vector<Points> lines;
  for (const Handle& handle : edited.handles)
    for (Points& line : handle_lines(handle, side)) lines.push_back(std::move(line));
  for (const std::vector<std::int32_t>& curve : edited.curves)
    lines.emplace_back(side.shape.vertices(curve, Eigen::all));
  return lines;
}

/// The shape; parts that were edited as a whole are red.
Scene scene_of(const Side& side, const std::vector<Handle>& handles) {
  SceneMesh mesh{side.shape, std::vector<Colour>(side.shape.part_names.size(), side.colour)};
  for (const Handle& handle : handles)
    if (handle.kind == HandleKind::part)
      mesh.colours.at(static_cast<std::size_t>(handle.part)) = mix(side.colour, palette::contact, 0.8);
  Scene scene;
  scene.add(std::move(mesh));
  return scene;
}

/// The other handles, drawn over the picture: many lie inside the surface.
detail::Elements marks(const std::vector<Points>& lines, const View& view, const Rectangle& place) {
  detail::Elements elements;
  for (const Points& line : lines) {
    PlanePoints points(line.rows(), 2);
    for (Eigen::Index i = 0; i < line.rows(); ++i)
      points.row(i) = (Eigen::Vector2d(place.x, place.y) + view.project(line.row(i).transpose())).transpose();
    if (points.rows() == 1)
      elements.emplace_back(
          FilledPolygon{detail::circle(points.row(0).transpose(), 2 * handle_width), palette::contact});
    else
      elements.emplace_back(Polyline{std::move(points), palette::contact, handle_width});
  }
  return elements;
}

}  // namespace

Drawing deformation_picture(const StructuredShape& rest, const DeformationResult& result,
                            const std::vector<Handle>& handles, const DeformationPictureOptions& options) {
  if (result.refusal) throw UsageError("an edit that was refused has no picture");
  std::vector<Primitive> at_rest;
  if (!result.primitives.empty())  // else the handles are not those of primitives
    for (const Part& part : rest.structure.parts) at_rest.push_back(part.primitive);
  const std::array<Side, 2> sides{{{rest.shape, at_rest, palette::input, "before"},
                                   {result.shape, result.primitives, palette::output, "after"}}};
  const Edited edited{handles, options.curves};
  const double size = options.width / 60.0, margin = 1.5 * size;
  Drawing drawing{options.width, options.height, {}};
  const detail::Heading heading = detail::heading(options.title, options.notes, options.width, size);
  drawing.add(heading.elements);
  const double top = heading.bottom + size, column = (options.width - 3 * margin) / 2;
  const double height = options.height - top - 3 * size;
  ViewOptions view_options;
  view_options.width = static_cast<int>(column);
  view_options.height = static_cast<int>(height);
  const std::array<Scene, 2> scenes{scene_of(sides[0], handles), scene_of(sides[1], handles)};
  Scene both = scenes[0];
  both.add(scenes[1]);
  for (const Side& side : sides) both.add(SceneLines{lines_of(edited, side)});
  const View view = fit_view(both, Direction(0, 0, 1), view_options);
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const Rectangle place{margin + static_cast<double>(k) * (column + margin), top, column, height};
    drawing.add(PlacedImage{place, render(scenes[k], view)});
    drawing.add(marks(lines_of(edited, sides[k]), view, place));
    std::vector<detail::LegendEntry> entries{{LegendMark::swatch, sides[k].colour, sides[k].caption}};
    if (!handles.empty()) entries.push_back({LegendMark::line, palette::contact, "what was edited"});
    drawing.add(detail::legend(entries, {place.x, place.bottom() + 0.3 * size, column, 2 * size}, size));
  }
  return drawing;
}

}  // namespace stackabilization
