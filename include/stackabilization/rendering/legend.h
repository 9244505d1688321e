#pragma once

#include <string>

#include "stackabilization/rendering/colour.h"

namespace stackabilization {

/// What stands before a line of a legend.
enum class LegendMark { swatch, dot, bar, line, ring };

/// One entry of a legend.
struct LegendEntry {
  LegendMark mark = LegendMark::swatch;  ///< what stands before the text
  Colour colour;                         ///< of the mark
  std::string text;                      ///< what the mark means
};

}  // namespace stackabilization
