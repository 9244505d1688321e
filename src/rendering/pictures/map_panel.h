#pragma once

#include <vector>

#include "rendering/drawing/plot_parts.h"
#include "stackabilization/stacking/map.h"

namespace stackabilization::detail {

/// The sample of largest S, the first of equal ones. Throws UsageError when there is none, a direction is
/// zero or a value is not finite.
const MapSample& best_sample(const std::vector<MapSample>& samples);

/// Disc of S over the hemisphere z >= 0 with its colour bar, the best sample marked: see map_picture. Throws
/// as `best_sample` does. Private to rendering/.
Elements map_panel(const Rectangle& place, const std::vector<MapSample>& samples, double text_size);

}  // namespace stackabilization::detail
