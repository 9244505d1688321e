#pragma once

#include <string>
#include <vector>

#include "stackabilization/rendering/colour.h"
#include "stackabilization/rendering/plot_parts.h"

namespace stackabilization {

/// What stands before a line of a legend.
enum class LegendMark { swatch, dot, bar, line, ring };

struct LegendEntry {
  LegendMark mark = LegendMark::swatch;
  Colour colour;
  std::string text;
};

}  // namespace stackabilization

namespace stackabilization::detail {

/// Entries from left to right in rows as wide as `place`; what does not fit its height is counted in a last
/// entry, "and 5 more". Nothing when not even one row fits. Private to rendering/.
Elements legend(const std::vector<LegendEntry>& entries, const Rectangle& place, double text_size);

}  // namespace stackabilization::detail
