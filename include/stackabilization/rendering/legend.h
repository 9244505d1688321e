#pragma once

#include <string>

#include "stackabilization/rendering/colour.h"

namespace stackabilization {

/// Mark in front of a legend entry.
enum class LegendMark { swatch, dot, bar, line, ring };

/// One entry of a legend.
struct LegendEntry {
  LegendMark mark = LegendMark::swatch;  ///< mark in front of the text
  Colour colour;                         ///< colour of the mark
  std::string text;                      ///< meaning of the mark
};

}  // namespace stackabilization
