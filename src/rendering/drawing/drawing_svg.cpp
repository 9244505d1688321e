#include <array>
#include <cmath>
#include <string_view>

#include "io/formats/formats.h"
#include "stackabilization/core/number_text.h"
#include "stackabilization/io/encodings.h"
#include "stackabilization/rendering/drawing.h"

namespace stackabilization {
namespace {

/// Hundredths of a pixel are finer than anyone sees.
std::string number(double value) {
  return shortest_text(std::round(value * 100) / 100);
}

std::string hex(const Colour& colour) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text = "#";
  for (const double component : {colour.red, colour.green, colour.blue}) {
    const auto value = static_cast<std::size_t>(std::lround(255 * component));
    text += digits[value / 16];
    text += digits[value % 16];
  }
  return text;
}

std::string list(const PlanePoints& points) {
  std::string text;
  for (Eigen::Index k = 0; k < points.rows(); ++k) {
    if (k > 0) text += ' ';
    text += number(points(k, 0));
    text += ',';
    text += number(points(k, 1));
  }
  return text;
}

std::string element(const FilledPolygon& polygon) {
  return "<polygon fill-rule=\"evenodd\" fill=\"" + hex(polygon.colour) + "\" points=\"" +
         list(polygon.points) + "\"/>\n";
}

std::string element(const Polyline& line) {
  return "<polyline fill=\"none\" stroke=\"" + hex(line.colour) + "\" stroke-width=\"" + number(line.width) +
         "\" points=\"" + list(line.points) + "\"/>\n";
}

std::string element(const Text& text) {
  constexpr std::array<std::string_view, 3> anchors{"start", "middle", "end"};
  const std::string x = number(text.at.x()), y = number(text.at.y());
  return "<text x=\"" + x + "\" y=\"" + y + "\" font-size=\"" + number(text.size) + "\" fill=\"" +
         hex(text.colour) + "\" text-anchor=\"" +
         std::string(anchors[static_cast<std::size_t>(text.anchor)]) + "\"" +
         (text.bold ? " font-weight=\"bold\"" : "") +
         (text.upwards ? " transform=\"rotate(-90 " + x + " " + y + ")\"" : "") + ">" +
         escaped_xml(text.text) + "</text>\n";
}

std::string element(const PlacedImage& placed) {
  return "<image x=\"" + number(placed.place.x) + "\" y=\"" + number(placed.place.y) + "\" width=\"" +
         number(placed.place.width) + "\" height=\"" + number(placed.place.height) +
         "\" preserveAspectRatio=\"none\"" +
         (placed.sampling == Sampling::cells ? " image-rendering=\"pixelated\"" : "") +
         " xlink:href=\"data:image/png;base64," + base64_text(png_bytes(placed.image)) + "\"/>\n";
}

}  // namespace

std::string svg_text(const Drawing& drawing) {
  const std::string width = std::to_string(drawing.width), height = std::to_string(drawing.height);
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
      "version=\"1.1\" width=\"" +
      width + "\" height=\"" + height + "\" viewBox=\"0 0 " + width + " " + height +
      "\" font-family=\"Arial, Liberation Sans, DejaVu Sans, sans-serif\">\n<rect width=\"100%\" "
      "height=\"100%\" "
      "fill=\"#ffffff\"/>\n";
  for (const auto& item : drawing.elements)
    text += std::visit([](const auto& e) { return element(e); }, item);
  return text + "</svg>\n";
}

}  // namespace stackabilization
