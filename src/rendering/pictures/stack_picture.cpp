#include <algorithm>
#include <limits>

#include "rendering/drawing/plot_parts.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/rendering/pictures.h"
#include "stackabilization/rendering/scene.h"
#include "stackabilization/rendering/stacking_scene.h"

namespace stackabilization {
namespace {

struct PictureExtent {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  double left = low;  ///< leftmost point in the picture, pixels
};

PictureExtent height_range(const std::vector<Shape>& copies, const Eigen::Vector3d& up, const View& view) {
  PictureExtent range;
  for (const Shape& shape : copies)
    for (const std::int32_t vertex : shape.triangles.reshaped<Eigen::RowMajor>()) {
      const Eigen::Vector3d point = shape.vertices.row(vertex).transpose();
      range.low = std::min(range.low, up.dot(point));
      range.high = std::max(range.high, up.dot(point));
      range.left = std::min(range.left, view.project(point).x());
    }
  return range;
}

}  // namespace

Drawing stack_picture(const std::vector<Shape>& copies, const Direction& direction,
                      const StackPictureOptions& options) {
  if (copies.empty()) throw UsageError("a picture of a stack needs at least one copy");
  const double size = options.width / 60.0, margin = 1.5 * size;
  Drawing drawing{options.width, options.height, {}};
  const detail::Heading heading = detail::heading(options.title, options.notes, options.width, size);
  drawing.add(heading.elements);
  const double top = heading.bottom + size;

  Scene scene = stack_scene(copies, palette::input);
  for (const Shape& body : options.separators) scene.add(SceneMesh{body, {palette::lower}});
  const double height = options.height - top - margin, dimension_room = 3 * size;
  const double width = (options.width - 2 * margin) / (options.side_view ? 2 : 1);
  ViewOptions view_options;
  view_options.width = static_cast<int>(width);
  view_options.height = static_cast<int>(height);
  drawing.add(
      PlacedImage{{margin, top, width, height}, render(scene, fit_view(scene, direction, view_options))});
  if (!options.side_view) return drawing;

  const Rectangle side{margin + width + dimension_room, top, width - dimension_room, height};
  view_options.width = static_cast<int>(side.width);
  view_options.elevation_degrees = 0;
  view_options.azimuth_degrees = 0;
  const View view = fit_view(scene, direction, view_options);
  drawing.add(PlacedImage{side, render(scene, view)});
  const Eigen::Vector3d up = direction.unit();
  const PictureExtent range = height_range(copies, up, view);
  const auto level = [&](double z) {
    return side.y + view.project(view.centre + (z - up.dot(view.centre)) * up).y();
  };
  drawing.add(detail::vertical_dimension(
      {side.x + range.left - size, level(range.low), level(range.high),
       "total height " + detail::length_text(range.high - range.low, copies.front().unit), Anchor::left},
      size));
  return drawing;
}

}  // namespace stackabilization
