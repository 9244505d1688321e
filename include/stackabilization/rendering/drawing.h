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

  double right() const { return x + width; }    ///< x of the right side, pixels
  double bottom() const { return y + height; }  ///< y of the lower side, pixels
};

/// Filled polygon (even-odd rule).
struct FilledPolygon {
  PlanePoints points;  ///< corners in order, not repeated
  Colour colour;       ///< inside
};

/// Open polyline with square joints.
struct Polyline {
  PlanePoints points;  ///< in order
  Colour colour;       ///< of the line
  double width = 1;    ///< pixels
};

/// Which point of a text lies where it is placed.
enum class Anchor { left, centre, right };

/// One line of text, UTF-8, sans serif.
struct Text {
  Eigen::Vector2d at;            ///< anchor on the base line, pixels
  std::string text;              ///< UTF-8, no line breaks
  double size = 16;              ///< pixels per em
  Colour colour = palette::ink;  ///< of the letters
  Anchor anchor = Anchor::left;  ///< horizontally
  bool bold = false;             ///< heavier weight
  bool upwards = false;          ///< reads from bottom to top
};

/// How an image is stretched to its rectangle.
enum class Sampling {
  smooth,  ///< averaged where it is shrunk: supersampled pictures
  cells,   ///< every pixel of the image stays a sharp rectangle: sampled data
};

/// A raster image in a drawing.
struct PlacedImage {
  Rectangle place;                       ///< that the image fills
  Image image;                           ///< any size
  Sampling sampling = Sampling::smooth;  ///< how it is stretched
};

/// What a Drawing is made of.
using DrawingElement = std::variant<FilledPolygon, Polyline, Text, PlacedImage>;

/// A flat picture made of shapes, text and images, in drawing order on white ground. It becomes a PNG or an
/// SVG file; neither needs OpenGL.
struct Drawing {
  int width = 0, height = 0;             ///< pixels
  std::vector<DrawingElement> elements;  ///< later ones cover earlier ones

  /// On top of all before.
  void add(DrawingElement element) { elements.push_back(std::move(element)); }
  /// In their order, on top of all before.
  void add(const std::vector<DrawingElement>& more) {
    elements.insert(elements.end(), more.begin(), more.end());
  }
};

/// Anti-aliased pixels of a drawing. Throws UsageError unless 1 <= width, height <= 16384.
Image rasterize(const Drawing& drawing);

/// Width of a text in pixels, as `rasterize` draws it.
double text_width(const Text& text);

/// The drawing as an SVG 1.1 document: shapes and text as such, images embedded.
std::string svg_text(const Drawing& drawing);

/// Writes a PNG or an SVG file, as the extension says, through a temporary name. Throws UsageError for any
/// other extension and OutputError when the file cannot be written.
void write_drawing(const std::filesystem::path& path, const Drawing& drawing);

}  // namespace stackabilization
