#pragma once

#include <vector>

#include "rendering/drawing/plot_parts.h"
#include "stackabilization/stacking/map.h"

namespace stackabilization::detail {

/// Returns the sample with the largest S, the first of equal ones. Throws UsageError when there is none, a
/// direction is zero or a value is not finite.
const MapSample& best_sample(const std::vector<MapSample>& samples);

/// Draws the disc of S over the hemisphere z >= 0 with its colour bar and a mark at the best sample: see
/// map_picture. Throws as `best_sample` does.
Elements map_panel(const Rectangle& place, const std::vector<MapSample>& samples, double text_size);

}  // namespace stackabilization::detail
