#pragma once

#include <optional>

#include "rendering/drawing/plot_parts.h"
#include "stackabilization/rendering/panel_sheet.h"

/// A scene with what is drawn over it, in a place of a drawing. Private to rendering/.
namespace stackabilization::detail {

/// How a scene is drawn into its place.
struct SceneStyle {
  double text_size = 16;                  ///< pixels per em
  std::optional<double> pixels_per_unit;  ///< default: as many as fit
};

/// The largest scale in which the scene, its arrows and its dimensions fit, pixels per unit. Throws
/// UsageError when the scene is empty.
double scale_of(const ScenePanel& panel, const Rectangle& place, double text_size);

/// Height that the panel takes at `pixels_per_unit` in a place of that width, pixels.
double height_at(const ScenePanel& panel, const Rectangle& place, const SceneStyle& style);

/// The picture and over it the overlay. Throws as `render` does.
Elements scene_elements(const ScenePanel& panel, const Rectangle& place, const SceneStyle& style);

}  // namespace stackabilization::detail
