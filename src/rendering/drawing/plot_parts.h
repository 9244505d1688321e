#pragma once

#include <string>
#include <vector>

#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/height_field.h"
#include "stackabilization/rendering/drawing.h"

/// Pieces that several pictures share.
namespace stackabilization::detail {

using Elements = std::vector<DrawingElement>;

/// Shortest text with `digits` significant digits, locale independent: 0.5, 12.34, 14630, 1.2e-07.
std::string number_text(double value, int digits = 4);
/// The first one with the unit's symbol, when it is known.
std::string length_text(double value, Unit unit);

/// "(1, 0, 0.5)".
std::string vector_text(const Eigen::Vector3d& vector);

/// The text, made smaller if it is wider than `width` pixels.
Text fitted(Text text, double width);

/// White text with a dark outline, readable on any colour.
Elements outlined(const Text& text);

/// Heading of a picture: a title (bold, may be empty) and lines below it, from the top left; made smaller
/// where they would not fit into `width` pixels. `bottom` is the last base line.
struct Heading {
  Elements elements;
  double bottom = 0;
};
Heading heading(const std::string& title, const std::vector<std::string>& lines, double width,
                double text_size);

/// Text broken into lines between words, at most `width` pixels wide, downwards from the anchor of `style`.
Elements paragraph(const Text& style, double width);

/// Vertical bar from low (bottom) to high (top) in viridis with round ticks at its right, and its title
/// above.
struct ColourScale {
  double low = 0, high = 1;
  std::string title;
};
Elements colour_bar(const Rectangle& place, const ColourScale& scale, double text_size);

/// Where a vertical dimension line stands. Its caption reads upwards, left of the line or right of it.
struct Dimension {
  double x = 0, from = 0, to = 0;  ///< pixels
  std::string caption;
  Anchor side = Anchor::left;
};
Elements vertical_dimension(const Dimension& dimension, double text_size);

/// Hollow circle of a given radius.
Elements ring_mark(const Eigen::Vector2d& centre, double radius, const Colour& colour);

/// Gap image with colour bar, the place of its maximum, and the frame's axes u and v.
Elements gap_panel(const Rectangle& place, const HeightField& field, double text_size);

/// Round tick values inside [low, high], at most `count` + 1.
std::vector<double> ticks(double low, double high, int count);

PlanePoints segment(double x0, double y0, double x1, double y1);
PlanePoints circle(const Eigen::Vector2d& centre, double radius);

}  // namespace stackabilization::detail
