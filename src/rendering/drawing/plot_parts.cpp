#include "rendering/drawing/plot_parts.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "stackabilization/core/number_text.h"

namespace stackabilization::detail {
namespace {

constexpr double line_width = 1.5;

FilledPolygon arrow_head(const Eigen::Vector2d& tip, double direction, double size) {
  PlanePoints points(3, 2);
  points << tip.x(), tip.y(), tip.x() - 0.38 * size, tip.y() - direction * size, tip.x() + 0.38 * size,
      tip.y() - direction * size;
  return {points, palette::ink};
}

/// Value of the brightest colour of a gap image: the largest gap, but at least a small fraction of the
/// height, so that rounding is invisible.
double colour_ceiling(const HeightField& field, double largest_gap) {
  constexpr double fraction = 0.001;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int i = 0; i < field.window.columns; ++i)
    for (int j = 0; j < field.window.rows; ++j)
      if (field.covered(i, j)) {
        low = std::min(low, field.lower(i, j));
        high = std::max(high, field.upper(i, j));
      }
  return low <= high ? std::max(largest_gap, fraction * (high - low)) : 0;
}

/// Image of the gap with v upwards; white where nothing is covered.
Image gap_image(const Eigen::MatrixXd& values, double maximum) {
  Image image(static_cast<int>(values.rows()), static_cast<int>(values.cols()), palette::white);
  for (int i = 0; i < image.width; ++i)
    for (int j = 0; j < image.height; ++j)
      if (!std::isnan(values(i, j)))
        image.set_pixel(i, image.height - 1 - j, viridis(maximum > 0 ? values(i, j) / maximum : 0));
  return image;
}

}  // namespace

std::string number_text(double value, int digits) {
  constexpr double max_plain_number = 10000000;
  const std::string text = significant_text(value, digits);
  if (text.find("e+") == std::string::npos || std::abs(value) >= max_plain_number) return text;
  double rounded = 0;
  std::from_chars(text.data(), text.data() + text.size(), rounded);
  return significant_text(rounded, 8);
}

std::string length_text(double value, Unit unit) {
  std::string text = number_text(value);
  if (unit != Unit::unknown) text.append(" ").append(unit_symbol(unit));
  return text;
}

std::string vector_text(const Eigen::Vector3d& vector) {
  std::string text;
  for (const double component : vector) {
    text += text.empty() ? "(" : ", ";
    text += number_text(component);
  }
  return text.append(")");
}

PlanePoints segment(double x0, double y0, double x1, double y1) {
  PlanePoints points(2, 2);
  points << x0, y0, x1, y1;
  return points;
}

PlanePoints circle(const Eigen::Vector2d& centre, double radius) {
  constexpr int sides = 96;
  PlanePoints points(sides + 1, 2);
  for (int k = 0; k <= sides; ++k) {
    const double angle = 2 * std::numbers::pi * (k % sides) / sides;
    points.row(k) << centre.x() + radius * std::cos(angle), centre.y() + radius * std::sin(angle);
  }
  return points;
}

Text fitted(Text text, double width) {
  // Font sizes are whole pixels, so the first guess can be a little too wide.
  while (text.size > 1 && text_width(text) > width)
    text.size = std::max(1.0, std::min(text.size - 1, std::floor(text.size * width / text_width(text))));
  return text;
}

Elements outlined(const Text& text) {
  Elements elements;
  Text copy = text;
  copy.colour = palette::ink;
  for (const Eigen::Vector2d& shift :
       {Eigen::Vector2d(1, 0), Eigen::Vector2d(-1, 0), Eigen::Vector2d(0, 1), Eigen::Vector2d(0, -1)}) {
    copy.at = text.at + shift;
    elements.emplace_back(copy);
  }
  copy.at = text.at;
  copy.colour = palette::white;
  elements.emplace_back(copy);
  return elements;
}

Heading heading(const std::string& title, const std::vector<std::string>& lines, double width,
                double text_size) {
  const double margin = 1.5 * text_size;
  Heading result{{}, 0.9 * text_size};
  if (!title.empty()) {
    result.bottom = 2.4 * text_size;
    result.elements.emplace_back(
        fitted({{margin, result.bottom}, title, 1.5 * text_size, palette::ink, Anchor::left, true},
               width - 2 * margin));
  }
  for (const std::string& line : lines) {
    result.bottom += 1.6 * text_size;
    result.elements.emplace_back(
        fitted({{margin, result.bottom}, line, text_size, palette::faint}, width - 2 * margin));
  }
  return result;
}

Elements paragraph(const Text& style, double width) {
  constexpr double leading = 1.3;
  Elements lines;
  Text line = style;
  line.text.clear();
  std::istringstream words(style.text);
  for (std::string word; words >> word;) {
    Text longer = line;
    longer.text += (line.text.empty() ? "" : " ") + word;
    if (!line.text.empty() && text_width(longer) > width) {
      lines.emplace_back(line);
      line.at.y() += leading * style.size;
      line.text = word;
    } else {
      line.text = longer.text;
    }
  }
  lines.emplace_back(line);
  return lines;
}

std::vector<double> ticks(double low, double high, int count) {
  const double raw = (high - low) / count;
  if (!(raw > 0) || !std::isfinite(raw)) return {low};
  const double power = std::pow(10, std::floor(std::log10(raw)));
  const double step = power * (raw <= power ? 1 : raw <= 2 * power ? 2 : raw <= 5 * power ? 5 : 10);
  std::vector<double> values;
  const double first = std::ceil(low / step), last = std::floor(high / step);
  for (double k = first; k <= last; ++k) values.push_back(k * step + 0.0);  // no -0
  return values;
}

Elements colour_bar(const Rectangle& place, const ColourScale& scale, double text_size) {
  constexpr int shades = 256;
  Image bar(1, shades, palette::white);
  for (int k = 0; k < shades; ++k) bar.set_pixel(0, k, viridis(1 - (k + 0.5) / shades));
  Elements elements{PlacedImage{place, bar, Sampling::smooth}};
  const double span = scale.high - scale.low;
  for (const double value : ticks(scale.low, scale.high, 6)) {
    const double y = place.bottom() - (span > 0 ? (value - scale.low) / span : 0) * place.height;
    elements.emplace_back(
        Polyline{segment(place.right(), y, place.right() + 5, y), palette::ink, line_width});
    elements.emplace_back(Text{{place.right() + 9, y + 0.35 * text_size}, number_text(value), text_size});
  }
  elements.emplace_back(Text{{place.x, place.y - 0.8 * text_size}, scale.title, text_size});
  return elements;
}

Elements vertical_dimension(const Dimension& d, double text_size) {
  const double head = std::min(10.0, std::abs(d.from - d.to) / 3), tick = 7;
  const double low = std::max(d.from, d.to), high = std::min(d.from, d.to);  // y grows downwards
  Elements elements{Polyline{segment(d.x, low, d.x, high), palette::ink, line_width},
                    Polyline{segment(d.x - tick, low, d.x + tick, low), palette::ink, line_width},
                    Polyline{segment(d.x - tick, high, d.x + tick, high), palette::ink, line_width},
                    arrow_head({d.x, low}, 1, head), arrow_head({d.x, high}, -1, head)};
  // The caption may be longer than the dimension: it stays clear of the ticks, ascenders and descenders too.
  const double clear = tick + 0.45 * text_size;
  const double offset = d.side == Anchor::left ? -clear : clear + 0.8 * text_size;
  elements.emplace_back(
      Text{{d.x + offset, (low + high) / 2}, d.caption, text_size, palette::ink, Anchor::centre, true, true});
  return elements;
}

Elements ring_mark(const Eigen::Vector2d& centre, double radius, const Colour& colour) {
  return {Polyline{circle(centre, radius), palette::white, 5}, Polyline{circle(centre, radius), colour, 2.5}};
}

Elements gap_panel(const Rectangle& place, const HeightField& field, double text_size) {
  const GapMaximum peak = maximum_gap(field);
  const double bar_room = 7 * text_size, foot = 2.2 * text_size, head = 2 * text_size;
  const Window& window = field.window;
  const double scale =
      std::min((place.width - bar_room) / window.columns, (place.height - foot - head) / window.rows);
  const Rectangle image{place.x, place.y + head, scale * window.columns, scale * window.rows};
  const double ceiling = colour_ceiling(field, peak.value);
  Elements elements{PlacedImage{image, gap_image(gap(field), ceiling), Sampling::cells}};
  if (peak.value > 0) {
    const Eigen::Vector2d at(image.x + (peak.column + 0.5) * scale,
                             image.bottom() - (peak.row + 0.5) * scale);
    const Elements mark = ring_mark(at, 0.45 * text_size, palette::contact);
    elements.insert(elements.end(), mark.begin(), mark.end());
  }
  const std::string symbol = unit_symbol(field.unit);
  const double bar_height = std::max(image.height, std::min(10 * text_size, place.height - foot - head));
  if (ceiling > 0) {
    const Elements bar = colour_bar({image.right() + 1.2 * text_size, image.y, 1.2 * text_size, bar_height},
                                    {0, ceiling, symbol.empty() ? "f" : "f in " + symbol}, text_size);
    elements.insert(elements.end(), bar.begin(), bar.end());
  }
  elements.emplace_back(Text{{image.x, place.bottom() - 0.6 * text_size},
                             std::to_string(window.columns) + " x " + std::to_string(window.rows) +
                                 " samples" +
                                 (peak.column < 0  ? ": none meets the shape"
                                  : peak.value > 0 ? ""
                                                   : ": f = 0 throughout"),
                             text_size,
                             palette::faint});
  return elements;
}

}  // namespace stackabilization::detail
