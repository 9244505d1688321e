#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "stackabilization/rendering/colour.h"
#include "stackabilization/rendering/image.h"

namespace stackabilization {

/// k x 2 points of a drawing, pixels, x to the right, y down.
using PlanePoints = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// Axis-parallel rectangle of a drawing, pixels.
struct Rectangle {
  double x = 0, y = 0;           ///< upper left corner
  double width = 0, height = 0;  ///< pixels

  /// Returns the x of the right side, pixels.
  double right() const { return x + width; }
  /// Returns the y of the lower side, pixels.
  double bottom() const { return y + height; }
};

/// Filled polygon (even-odd rule).
struct FilledPolygon {
  PlanePoints points;  ///< corners in order, not repeated
  Colour colour;       ///< fill colour
};

/// Open polyline with square joints.
struct Polyline {
  PlanePoints points;  ///< points in order
  Colour colour;       ///< of the line
  double width = 1;    ///< pixels
};

/// Point of a text that lies at its position.
enum class Anchor { left, centre, right };

/// One line of text, UTF-8, sans serif.
struct Text {
  Eigen::Vector2d at;            ///< anchor on the base line, pixels
  std::string text;              ///< UTF-8, no line breaks
  double size = 16;              ///< pixels per em
  Colour colour = palette::ink;  ///< of the letters
  Anchor anchor = Anchor::left;  ///< horizontal anchor
  bool bold = false;             ///< heavier weight
  bool upwards = false;          ///< whether the text reads from bottom to top
};

/// Interpolation of an image in its rectangle.
enum class Sampling {
  smooth,  ///< averaged when reduced: for supersampled pictures
  cells,   ///< every pixel stays a sharp rectangle: for sampled data
};

/// A raster image in a drawing.
struct PlacedImage {
  Rectangle place;                       ///< rectangle that the image fills
  Image image;                           ///< any size
  Sampling sampling = Sampling::smooth;  ///< interpolation
};

/// An element of a Drawing.
using DrawingElement = std::variant<FilledPolygon, Polyline, Text, PlacedImage>;

/// A flat picture of shapes, text and images, in drawing order on white ground. It can be written as PNG or
/// SVG, without OpenGL.
struct Drawing {
  int width = 0, height = 0;             ///< pixels
  std::vector<DrawingElement> elements;  ///< later ones cover earlier ones

  /// Adds an element on top of all others.
  void add(DrawingElement element) { elements.push_back(std::move(element)); }
  /// Adds elements in their order, on top of all others.
  void add(const std::vector<DrawingElement>& more) {
    elements.insert(elements.end(), more.begin(), more.end());
  }
};

/// Renders a drawing with anti-aliasing. Throws UsageError unless 1 <= width, height <= 16384.
Image rasterize(const Drawing& drawing);

/// Returns the width of a text in pixels, as `rasterize` draws it.
double text_width(const Text& text);

/// Returns the drawing as an SVG 1.1 document with vector shapes, text and embedded images.
std::string svg_text(const Drawing& drawing);

/// Writes a PNG or an SVG file, according to the extension, with write_file_atomically. Throws UsageError for
/// any other extension, and OutputError when the file cannot be written.
void write_drawing(const std::filesystem::path& path, const Drawing& drawing);

}  // namespace stackabilization
