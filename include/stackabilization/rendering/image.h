#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "stackabilization/rendering/colour.h"

namespace stackabilization {

/// 8-bit sRGB pixels, rows from top to bottom.
struct Image {
  int width = 0, height = 0;        ///< pixels
  std::vector<std::uint8_t> bytes;  ///< 3 per pixel

  Image() = default;
  /// Creates an image of one colour. Throws UsageError unless 1 <= width, height <= 16384.
  Image(int columns, int rows, const Colour& background);

  /// Returns red, green and blue at column x and row y. Precondition: inside the image.
  std::array<std::uint8_t, 3> pixel(int x, int y) const;
  /// Sets a pixel, rounded to 8 bits. Precondition: inside the image.
  void set_pixel(int x, int y, const Colour& colour);
};

/// Returns the image as a PNG file in memory. The same image gives the same bytes.
std::string png_bytes(const Image& image);

}  // namespace stackabilization
