#pragma once

#include "common/plot.h"
#include "stackabilization/rendering/drawing.h"

namespace stackabilization::experiments {

/// Is there anything to draw? Not when every model failed.
bool has_points(const Plot& plot);

/// The plot as a picture. Throws UsageError unless `has_points`.
Drawing drawing_of(const Plot& plot);

/// Plots that belong together as one picture, two in a row; a place without points stays empty. Throws
/// UsageError unless one of them `has_points`.
Drawing drawing_of(const std::vector<Plot>& plots);

}  // namespace stackabilization::experiments
