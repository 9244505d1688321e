#include <algorithm>

#include "rendering/drawing/plot_parts.h"
#include "rendering/pictures/handle_marks.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/mesh/boxes.h"
#include "stackabilization/rendering/pictures.h"
#include "stackabilization/rendering/scene.h"

namespace stackabilization {
namespace {

constexpr double picture_aspect = 0.85;  ///< height over width of a tile's picture
constexpr double relative_mark_lift =
    0.004;  ///< of contact marks above the surface, fraction of the box diagonal

Scene tile_scene(const DesignTile& tile, const Colour& colour, const Direction& direction) {
  Scene scene = detail::edited_scene(tile.shape, colour, tile.handles);
  const double lift = relative_mark_lift * axis_aligned_box(tile.shape.vertices).half_extents.norm() * 2;
  scene.add(contact_marks(tile.contacts, EnvelopeSide::upper, lift * direction.unit()));
  scene.add(contact_marks(tile.contacts, EnvelopeSide::lower, -lift * direction.unit()));
  return scene;
}

/// Size of a tile, pixels.
struct TileSize {
  double width = 0, picture = 0, text = 0, lines = 0;

  double height() const { return picture + (1.5 * lines + 1) * text; }
};

detail::Elements captions(const std::vector<std::string>& lines, const Rectangle& place, double size) {
  detail::Elements elements;
  for (std::size_t k = 0; k < lines.size(); ++k)
    elements.emplace_back(detail::fitted({{place.x, place.y + 1.5 * size * static_cast<double>(k + 1)},
                                          lines[k],
                                          size,
                                          k == 0 ? palette::ink : palette::faint,
                                          Anchor::left,
                                          k == 0},
                                         place.width));
  return elements;
}

}  // namespace

Drawing design_sheet(const std::vector<DesignTile>& tiles, const Direction& direction,
                     const DesignSheetOptions& options) {
  if (tiles.empty()) throw UsageError("a sheet of designs needs at least one");
  if (options.columns < 1) throw UsageError("a sheet of designs needs at least one column");
  const double size = options.width / 80.0, margin = 1.5 * size;
  const detail::Heading heading = detail::heading(options.title, options.notes, options.width, size);
  const double columns = options.columns;
  TileSize tile{(options.width - (columns + 1) * margin) / columns, 0, 0.85 * size, 0};
  tile.picture = picture_aspect * tile.width;
  std::vector<Scene> scenes, groups;  // a group: what is seen from one viewpoint
  std::vector<std::size_t> group_of;  // per tile
  std::vector<std::vector<Points>> lines;
  for (const DesignTile& one : tiles) {
    const bool at_rest = scenes.empty() || one.at_rest;
    if (at_rest) groups.emplace_back();
    group_of.push_back(groups.size() - 1);
    scenes.push_back(tile_scene(one, at_rest ? palette::input : palette::output, direction));
    groups.back().add(scenes.back());
    lines.push_back(detail::lines_of(one.handles, one.shape, one.primitives));
    tile.lines = std::max(tile.lines, static_cast<double>(one.captions.size()));
  }
  ViewOptions view_options;
  view_options.width = static_cast<int>(tile.width);
  view_options.height = static_cast<int>(tile.picture);
  std::vector<View> views;
  for (const Scene& group : groups) views.push_back(fit_view(group, direction, view_options));

  const std::size_t per_row = static_cast<std::size_t>(options.columns);
  const std::size_t rows = (tiles.size() + per_row - 1) / per_row;
  const double top = heading.bottom + size;
  Drawing drawing{options.width, static_cast<int>(top + static_cast<double>(rows) * tile.height()), {}};
  drawing.add(heading.elements);
  for (std::size_t k = 0; k < tiles.size(); ++k) {
    const Rectangle place{margin + static_cast<double>(k % per_row) * (tile.width + margin),
                          top + static_cast<double>(k / per_row) * tile.height(), tile.width, tile.picture};
    const View& view = views[group_of[k]];
    drawing.add(PlacedImage{place, render(scenes[k], view)});
    drawing.add(detail::handle_marks(lines[k], view, place));
    drawing.add(captions(tiles[k].captions, {place.x, place.bottom(), place.width, 0}, tile.text));
  }
  return drawing;
}

}  // namespace stackabilization
