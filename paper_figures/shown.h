#pragma once

#include <string>

#include "paper_figures/input.h"
#include "stackabilization/rendering/panel_sheet.h"
#include "stackabilization/rendering/pictures.h"
#include "stackabilization/stacking/stackability.h"

/// What several figures measure, draw and say.
namespace stackabilization::figures {

/// A shape measured along a direction, with its contact regions. Throws InputError as StackabilitySolver.
MeasuredShape measured_shape(const Shape& shape, const Direction& direction,
                             const StackabilityOptions& options = {});

/// A scene seen by `camera`, `direction` up.
ScenePanel scene_panel(Scene scene, const Direction& direction, const Camera& camera);

/// Equal copies above each other, each lifted by f_max.
Scene stack_of(const MeasuredShape& shape, int copies, const Colour& colour);

/// "0.412", "31.5 %", "12 mm": for captions.
std::string ratio_text(double value);
std::string percent_text(double fraction);
std::string length_text(double value, Unit unit);

/// "copies touch" and other lines of legends.
LegendEntry contact_entry();

}  // namespace stackabilization::figures
