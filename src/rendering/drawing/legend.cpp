#include "rendering/drawing/legend.h"

#include <algorithm>
#include <cstddef>

namespace stackabilization::detail {
namespace {

constexpr double row_step = 1.7;  ///< em, as all sizes here
constexpr double mark_width = 1.5;
constexpr double mark_gap = 0.5;
constexpr double entry_gap = 1.4;

PlanePoints rectangle(double x, double y, double width, double height) {
  PlanePoints points(4, 2);
  points << x, y, x + width, y, x + width, y + height, x, y + height;
  return points;
}

/// The mark of an entry whose text stands on base line `y`.
Elements mark_elements(const LegendEntry& entry, double x, double y, double size) {
  const double width = mark_width * size, middle = y - 0.33 * size;
  switch (entry.mark) {
    case LegendMark::swatch:
      return {FilledPolygon{rectangle(x, middle - 0.5 * size, width, size), entry.colour}};
    case LegendMark::dot:
      return {FilledPolygon{circle({x + width / 2, middle}, 0.45 * size), entry.colour}};
    case LegendMark::bar:
      return {FilledPolygon{rectangle(x, middle - 0.2 * size, width, 0.4 * size), entry.colour}};
    case LegendMark::line:
      return {Polyline{segment(x, middle, x + width, middle), entry.colour, 2}};
    case LegendMark::ring:
      return {Polyline{circle({x + width / 2, middle}, 0.5 * size), entry.colour, 2}};
  }
  return {};
}

}  // namespace

Elements legend(const std::vector<LegendEntry>& entries, const Rectangle& place, double text_size) {
  const int rows = static_cast<int>(place.height / (row_step * text_size));
  const double reserved = text_width({{0, 0}, "and 999 more", text_size});
  Elements elements;
  double x = place.x;
  int row = 0;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    Text text =
        fitted({{0, 0}, entries[k].text, text_size}, place.width - (mark_width + mark_gap) * text_size);
    const double width = (mark_width + mark_gap) * text_size + text_width(text);
    const bool last = k + 1 == entries.size();
    const auto right_end = [&] { return place.right() - (row + 1 >= rows && !last ? reserved : 0); };
    if (x > place.x && x + width > right_end()) {
      ++row;
      if (row < rows) x = place.x;
    }
    const double y =
        place.y + (std::min(row, std::max(rows, 1) - 1) + 1) * row_step * text_size - 0.5 * text_size;
    if (row >= rows) {
      if (rows > 0)
        elements.emplace_back(
            Text{{x, y}, "and " + std::to_string(entries.size() - k) + " more", text_size, palette::faint});
      break;
    }
    for (const DrawingElement& mark : mark_elements(entries[k], x, y, text_size)) elements.push_back(mark);
    text.at = {x + (mark_width + mark_gap) * text_size, y};
    elements.emplace_back(text);
    x += width + entry_gap * text_size;
  }
  return elements;
}

}  // namespace stackabilization::detail
