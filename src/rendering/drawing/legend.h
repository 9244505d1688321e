#pragma once

#include <vector>

#include "rendering/drawing/plot_parts.h"
#include "stackabilization/rendering/legend.h"

namespace stackabilization::detail {

/// Draws entries from left to right in rows as wide as `place`; what does not fit its height is counted in a
/// last entry, "and 5 more". Nothing when not even one row fits.
Elements legend(const std::vector<LegendEntry>& entries, const Rectangle& place, double text_size);

}  // namespace stackabilization::detail
