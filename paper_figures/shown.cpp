#include "paper_figures/shown.h"

#include <utility>

#include "stackabilization/core/number_text.h"
#include "stackabilization/rendering/stacking_scene.h"

namespace stackabilization::figures {
MeasuredShape measured_shape(const Shape& shape, const Direction& direction,
                             const StackabilityOptions& options) {
  const StackabilitySolver solver(shape, options);
  ContactOptions band;
  band.semantics = options.semantics;
  return {shape, solver.measure(direction),
          contact_regions({shape, solver.tree(), direction, solver.separation(direction)}, band).regions};
}

ScenePanel scene_panel(Scene scene, const Direction& direction, const Camera& camera) {
  return {std::move(scene), direction, camera.azimuth, camera.elevation, {}};
}

Scene stack_of(const MeasuredShape& shape, int copies, const Colour& colour) {
  const Eigen::Vector3d step = shape.measured.f_max * Direction(shape.measured.direction).unit();
  return stack_scene(copies_of(shape.shape, step, copies), colour);
}

std::string ratio_text(double value) {
  return fixed_text(value, 3);
}

std::string percent_text(double fraction) {
  return fixed_text(100 * fraction, 1) + " %";
}

std::string length_text(double value, Unit unit) {
  if (unit == Unit::unknown) return fixed_text(value, 3);
  constexpr double millimetres = 1000;
  return fixed_text(value * metres_per_unit(unit) * millimetres, 0) + " mm";
}

LegendEntry contact_entry() {
  return {LegendMark::swatch, palette::contact, "copies touch"};
}

}  // namespace stackabilization::figures
