#pragma once

#include <optional>

#include "rendering/drawing/plot_parts.h"
#include "stackabilization/rendering/panel_sheet.h"

/// Drawing of a scene and its overlay in a rectangle of a drawing.
namespace stackabilization::detail {

/// Style of a scene in a rectangle.
struct SceneStyle {
  double text_size = 16;  ///< pixels per em
  /// Scale; default: the largest that fits.
  std::optional<double> pixels_per_unit;
};

/// Computes the largest scale at which the scene, its arrows and its dimensions fit, pixels per unit. Throws
/// UsageError when the scene is empty.
double scale_of(const ScenePanel& panel, const Rectangle& place, double text_size);

/// Computes the height of the panel at `pixels_per_unit` in a rectangle of that width, pixels.
double height_at(const ScenePanel& panel, const Rectangle& place, const SceneStyle& style);

/// Draws the scene and its overlay. Throws as `render` does.
Elements scene_elements(const ScenePanel& panel, const Rectangle& place, const SceneStyle& style);

}  // namespace stackabilization::detail
