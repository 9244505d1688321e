#pragma once

#include <string>
#include <vector>

#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/height_field.h"
#include "stackabilization/rendering/drawing.h"

/// Drawing elements that several pictures share.
namespace stackabilization::detail {

using Elements = std::vector<DrawingElement>;

/// Returns the shortest text with `digits` significant digits, independent of the locale: 0.5, 12.34, 14630,
/// 1.2e-07.
std::string number_text(double value, int digits = 4);
/// Returns the number with the symbol of its unit, when the unit is known.
std::string length_text(double value, Unit unit);

/// Returns a text such as "(1, 0, 0.5)".
std::string vector_text(const Eigen::Vector3d& vector);

/// Returns the text with a smaller size when it is wider than `width` pixels.
Text fitted(Text text, double width);

/// Draws white text with a dark outline, readable on any colour.
Elements outlined(const Text& text);

/// Heading of a picture: a bold title (may be empty) and lines below it, from the top left. Text that is
/// wider than the picture is drawn smaller. `bottom` is the last base line.
struct Heading {
  Elements elements;
  double bottom = 0;
};
Heading heading(const std::string& title, const std::vector<std::string>& lines, double width,
                double text_size);

/// Draws text broken into lines between words, at most `width` pixels wide, downwards from the anchor of
/// `style`.
Elements paragraph(const Text& style, double width);

/// Values and title of a colour bar: a vertical bar from low (bottom) to high (top) in viridis, with round
/// ticks at the right and the title above.
struct ColourScale {
  double low = 0, high = 1;
  std::string title;
};
Elements colour_bar(const Rectangle& place, const ColourScale& scale, double text_size);

/// A vertical dimension line. Its caption reads upwards, to the left or to the right of the line.
struct Dimension {
  double x = 0, from = 0, to = 0;  ///< pixels
  std::string caption;
  Anchor side = Anchor::left;
};
Elements vertical_dimension(const Dimension& dimension, double text_size);

/// Draws a hollow circle.
Elements ring_mark(const Eigen::Vector2d& centre, double radius, const Colour& colour);

/// Draws a gap image with its colour bar, the position of its maximum, and the axes u and v of the frame.
Elements gap_panel(const Rectangle& place, const HeightField& field, double text_size);

/// Returns at most `count` + 1 round tick values inside [low, high].
std::vector<double> ticks(double low, double high, int count);

PlanePoints segment(double x0, double y0, double x1, double y1);
PlanePoints circle(const Eigen::Vector2d& centre, double radius);

}  // namespace stackabilization::detail
