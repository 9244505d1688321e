#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <variant>

#include "stackabilization/rendering/drawing.h"
#include "support/catch.h"

/// What the tests of pictures look at.
namespace stackabilization {

/// Every text inside the picture, every image too: nothing is clipped.
inline void check_nothing_clipped(const Drawing& drawing) {
  for (const DrawingElement& element : drawing.elements) {
    if (const auto* text = std::get_if<Text>(&element)) {
      const double length = text_width(*text);
      const double before = text->anchor == Anchor::left    ? 0
                            : text->anchor == Anchor::right ? length
                                                            : length / 2;
      const double x0 = text->upwards ? text->at.x() - text->size : text->at.x() - before;
      const double x1 = text->upwards ? text->at.x() : text->at.x() - before + length;
      const double y0 = text->upwards ? text->at.y() + before - length : text->at.y() - 0.8 * text->size;
      const double y1 = text->upwards ? text->at.y() + before : text->at.y() + 0.2 * text->size;
      INFO(text->text);
      CHECK(x0 >= 0);
      CHECK(y0 >= 0);
      CHECK(x1 <= drawing.width);
      CHECK(y1 <= drawing.height);
    }
    if (const auto* image = std::get_if<PlacedImage>(&element)) {
      CHECK(image->place.x >= 0);
      CHECK(image->place.y >= 0);
      CHECK(image->place.right() <= drawing.width);
      CHECK(image->place.bottom() <= drawing.height);
    }
  }
}

inline bool says(const Drawing& drawing, const std::string& words) {
  for (const DrawingElement& element : drawing.elements)
    if (const auto* text = std::get_if<Text>(&element);
        text != nullptr && text->text.find(words) != std::string::npos)
      return true;
  return false;
}

inline std::size_t distinct_colours(const Image& image) {
  std::set<std::array<std::uint8_t, 3>> colours;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) colours.insert(image.pixel(x, y));
  return colours.size();
}

/// Pixels whose hue is that of `colour`, in light and in shade.
inline int pixels_of(const Image& image, const Colour& colour) {
  const Eigen::Array3d wanted = Eigen::Array3d(colour.red, colour.green, colour.blue) /
                                std::max({colour.red, colour.green, colour.blue});
  int count = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const auto p = image.pixel(x, y);
      const Eigen::Array3d value(p[0], p[1], p[2]);
      if (value.maxCoeff() > 80 && (value / value.maxCoeff() - wanted).abs().maxCoeff() < 0.06) ++count;
    }
  return count;
}

inline std::array<std::uint8_t, 3> bytes_of(const Colour& colour) {
  Image one(1, 1, colour);
  return one.pixel(0, 0);
}

}  // namespace stackabilization
