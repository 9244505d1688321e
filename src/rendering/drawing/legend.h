#pragma once

#include <vector>

#include "rendering/drawing/plot_parts.h"
#include "stackabilization/rendering/legend.h"

namespace stackabilization::detail {

/// Draws entries from left to right in rows as wide as `place`. A last entry, "and 5 more", counts the
/// entries that do not fit the height. Returns nothing when no row fits.
Elements legend(const std::vector<LegendEntry>& entries, const Rectangle& place, double text_size);

}  // namespace stackabilization::detail
