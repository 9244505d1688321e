#include "paper_figures/shown.h"

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "stackabilization/rendering/stacking_scene.h"

namespace stackabilization::figures {
namespace {

std::string decimals(double value, int count) {
  std::array<char, 330> buffer{};
  const double unit = std::pow(10, count);
  const double rounded = std::round(value * unit) / unit + 0.0;  // no -0
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), rounded, std::chars_format::fixed, count);
  return {buffer.data(), end.ptr};
}

}  // namespace

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

std::string number_text(double value, int digits) {
  std::array<char, 64> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value + 0.0,
                                 std::chars_format::general, digits);
  return {buffer.data(), end.ptr};
}

std::string ratio_text(double value) {
  return decimals(value, 3);
}

std::string percent_text(double fraction) {
  return decimals(100 * fraction, 1) + " %";
}

std::string length_text(double value, Unit unit) {
  if (unit == Unit::unknown) return decimals(value, 3);
  constexpr double millimetres = 1000;
  return decimals(value * metres_per_unit(unit) * millimetres, 0) + " mm";
}

LegendEntry contact_entry() {
  return {LegendMark::swatch, palette::contact, "copies touch"};
}

}  // namespace stackabilization::figures
