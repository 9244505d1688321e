#include <algorithm>
#include <cmath>

#include "rendering/drawing/plot_parts.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/rendering/pictures.h"
#include "stackabilization/rendering/scene.h"

namespace stackabilization {
namespace {

Range height_range(const DropMap& map) {
  if (map.heights.empty()) throw UsageError("a picture of places needs at least one");
  const auto [low, high] = std::minmax_element(map.heights.begin(), map.heights.end());
  if (!std::isfinite(*low) || !std::isfinite(*high))
    throw UsageError("a picture of places needs finite heights");
  return {*low, *high};
}

/// One pixel per place, v upwards.
Image map_image(const DropMap& map, const Range& range) {
  Image image(static_cast<int>(map.x.size()), static_cast<int>(map.y.size()), palette::white);
  for (int i = 0; i < image.width; ++i)
    for (int j = 0; j < image.height; ++j) {
      const double height = map.heights[static_cast<std::size_t>(j * image.width + i)];
      const double share = range.length() > 0 ? (height - range.low) / range.length() : 0;
      image.set_pixel(i, image.height - 1 - j, viridis(share));
    }
  return image;
}

/// Position of a coordinate among evenly spaced ones: 0 at the first.
double index_of(double coordinate, const std::vector<double>& grid) {
  if (grid.size() < 2) return 0;
  return (coordinate - grid.front()) / (grid[1] - grid[0]);
}

detail::Elements map_elements(const DroppedShape& dropped, const Rectangle& place, double size) {
  const DropMap& map = dropped.map;
  const Range range = height_range(map);
  const auto columns = static_cast<double>(map.x.size()), rows = static_cast<double>(map.y.size());
  const double head = 3.5 * size, foot = 2.2 * size, bar_room = 7 * size;
  const double cell = std::min((place.width - bar_room) / columns, (place.height - head - foot) / rows);
  const Rectangle image{place.x, place.y + head, cell * columns, cell * rows};
  detail::Elements elements{PlacedImage{image, map_image(map, range), Sampling::cells}};
  const auto append = [&](const detail::Elements& more) {
    elements.insert(elements.end(), more.begin(), more.end());
  };
  const double i = index_of(dropped.place.x, map.x), j = index_of(dropped.place.y, map.y);
  const bool inside =
      std::abs(i - (columns - 1) / 2) <= columns / 2 && std::abs(j - (rows - 1) / 2) <= rows / 2;
  if (inside)
    append(detail::ring_mark({image.x + (i + 0.5) * cell, image.bottom() - (j + 0.5) * cell}, 0.45 * size,
                             palette::contact));
  const std::string symbol = unit_symbol(dropped.base.unit);
  if (range.length() > 0)
    append(detail::colour_bar(
        {image.right() + 1.2 * size, image.y, 1.2 * size, std::max(image.height, 8 * size)},
        {range.low, range.high, symbol.empty() ? "height" : "height in " + symbol}, size));
  const std::string count = std::to_string(map.x.size()) + " x " + std::to_string(map.y.size());
  elements.emplace_back(detail::fitted(
      Text{{place.x, image.bottom() + 1.6 * size},
           count + " places of its centre" +
               (range.length() > 0
                    ? ""
                    : ", " + detail::length_text(range.low, dropped.base.unit) + " high at each") +
               (inside ? "" : "; it lies at none of them"),
           size,
           palette::faint},
      place.width));
  return elements;
}

}  // namespace

Drawing drop_picture(const DroppedShape& dropped, const DropPictureOptions& options) {
  const double size = options.width / 70.0, margin = 1.5 * size;
  Drawing drawing{options.width, options.height, {}};
  const detail::Heading heading = detail::heading(options.title, options.notes, options.width, size);
  drawing.add(heading.elements);
  const double top = heading.bottom + size, height = options.height - top - margin;
  const double width = (options.width - 3 * margin) / 2;
  drawing.add(map_elements(dropped, {2 * margin + width, top, width, height}, size));

  Scene scene;
  scene.add(SceneMesh{dropped.base, {palette::input}});
  scene.add(SceneMesh{dropped.shape, {palette::lower}});
  ViewOptions view;
  view.width = static_cast<int>(width);
  view.height = static_cast<int>(height);
  drawing.add(
      PlacedImage{{margin, top, width, height}, render(scene, fit_view(scene, dropped.direction, view))});
  return drawing;
}

}  // namespace stackabilization
