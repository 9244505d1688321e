#include "stackabilization/rendering/panel_sheet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "rendering/drawing/legend.h"
#include "rendering/drawing/plot_parts.h"
#include "rendering/pictures/map_panel.h"
#include "rendering/pictures/scene_overlay.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {
namespace {

using detail::Elements;

constexpr double caption_lead = 1.35;  ///< em from line to line
constexpr double highest = 10;
constexpr double legend_row = 1.7, max_legend_rows = 4;  ///< em

/// Layout of a row, pixels.
struct RowLayout {
  std::vector<Rectangle> places;  ///< of the contents
  double captions = 0;            ///< height of the block below them
};

/// Title and captions of a panel below `place`.
Elements captions_of(const Panel& panel, const Rectangle& place, double size) {
  Elements elements;
  const double middle = place.x + place.width / 2;
  double y = place.bottom() + 1.1 * size;
  if (!panel.title.empty()) {
    elements.emplace_back(
        detail::fitted({{middle, y}, panel.title, size, palette::ink, Anchor::centre, true}, place.width));
    y += caption_lead * size;
  }
  for (const std::string& caption : panel.captions)
    for (const DrawingElement& line :
         detail::paragraph({{middle, y}, caption, size, palette::faint, Anchor::centre}, place.width)) {
      elements.push_back(line);
      y += caption_lead * size;
    }
  return elements;
}

/// Last base line of the texts among `elements`, pixels; 0 when there is none.
double lowest_text(const Elements& elements) {
  double lowest = 0;
  for (const DrawingElement& element : elements)
    if (const auto* text = std::get_if<Text>(&element)) lowest = std::max(lowest, text->at.y());
  return lowest;
}

void check(const std::vector<PanelRow>& rows) {
  for (const PanelRow& row : rows) {
    if (row.panels.empty()) throw UsageError("a row of a sheet needs at least one panel");
    if (!(row.height > 0) || row.height > highest)
      throw UsageError("the height of a row must be above 0 and at most 10 times the width");
    for (const Panel& panel : row.panels)
      if (!(panel.share > 0) || !std::isfinite(panel.share))
        throw UsageError("the share of a panel in its row must be a finite number above 0");
  }
}

RowLayout layout_of(const PanelRow& row, double top, const PanelSheetOptions& options) {
  const double margin = 0.8 * options.text_size;
  double shares = 0;
  for (const Panel& panel : row.panels) shares += panel.share;
  const double room = options.width - margin * static_cast<double>(row.panels.size() + 1);
  RowLayout layout;
  double x = margin;
  for (const Panel& panel : row.panels) {
    const double width = room * panel.share / shares;
    layout.places.push_back({x, top, width, row.height * options.width});
    x += width + margin;
    const auto lines =
        static_cast<double>(captions_of(panel, layout.places.back(), options.text_size).size());
    if (lines > 0)
      layout.captions = std::max(layout.captions, (caption_lead * lines + 0.5) * options.text_size);
  }
  return layout;
}

/// Returns the scale, pixels per unit, at which every scene of the row fits.
std::optional<double> common_scale(const PanelRow& row, const RowLayout& layout, double size) {
  if (row.scale == PanelScale::own) return std::nullopt;
  double scale = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < row.panels.size(); ++k)
    if (const auto* panel = std::get_if<ScenePanel>(&row.panels[k].content))
      scale = std::min(scale, detail::scale_of(*panel, layout.places[k], size));
  if (!std::isfinite(scale)) return std::nullopt;
  return scale;
}

/// Returns the height that the row needs: scenes limited by their width may be lower.
double used_height(const PanelRow& row, const RowLayout& layout, const detail::SceneStyle& style) {
  double used = 0;
  for (std::size_t k = 0; k < row.panels.size(); ++k) {
    const Rectangle& place = layout.places[k];
    const auto* panel = std::get_if<ScenePanel>(&row.panels[k].content);
    used = std::max(used, panel == nullptr ? place.height : detail::height_at(*panel, place, style));
  }
  return std::min(std::ceil(used), layout.places.front().height);
}

}  // namespace

Drawing panel_sheet(const std::vector<PanelRow>& rows, const PanelSheetOptions& options) {
  check(rows);
  const double size = options.text_size;
  const detail::Heading heading = detail::heading(options.title, options.notes, options.width, size);
  const bool headed = !heading.elements.empty();
  double top = headed ? heading.bottom + size : 0.6 * size;
  Drawing drawing{options.width, 0, {}};
  drawing.add(heading.elements);
  for (const PanelRow& row : rows) {
    RowLayout layout = layout_of(row, top, options);
    const std::optional<double> scale = common_scale(row, layout, size);
    const double height = used_height(row, layout, {size, scale});
    for (Rectangle& place : layout.places) place.height = height;
    for (std::size_t k = 0; k < row.panels.size(); ++k) {
      const Panel& panel = row.panels[k];
      const Rectangle& place = layout.places[k];
      if (const auto* scene = std::get_if<ScenePanel>(&panel.content))
        drawing.add(detail::scene_elements(*scene, place, {size, scale}));
      else if (const auto* plot = std::get_if<CurvePlot>(&panel.content))
        drawing.add(plot_elements(*plot, place, size));
      else if (const auto* field = std::get_if<HeightField>(&panel.content))
        drawing.add(detail::gap_panel(place, *field, size));
      else
        drawing.add(detail::map_panel(place, std::get<StackabilityMap>(panel.content).samples, size));
      drawing.add(captions_of(panel, place, size));
    }
    top += height + layout.captions + 0.5 * size;
  }
  const Rectangle foot{size, top, options.width - 2 * size, max_legend_rows * legend_row * size};
  const Elements legend = detail::legend(options.legend, foot, size);
  drawing.add(legend);
  drawing.height = static_cast<int>(std::ceil(std::max(top, lowest_text(legend) + 0.8 * size)));
  return drawing;
}

}  // namespace stackabilization
