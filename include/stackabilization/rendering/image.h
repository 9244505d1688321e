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
  /// One colour everywhere. Throws UsageError unless 1 <= width, height <= 16384.
  Image(int columns, int rows, const Colour& background);

  /// Red, green, blue at column x and row y. Precondition: inside the image.
  std::array<std::uint8_t, 3> pixel(int x, int y) const;
  /// Rounds to 8 bits. Precondition: inside the image.
  void set_pixel(int x, int y, const Colour& colour);
};

/// The image as a PNG file in memory; the same image gives the same bytes.
std::string png_bytes(const Image& image);

}  // namespace stackabilization
