#include "stackabilization/stacking/map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "stackabilization/core/errors.h"
#include "stackabilization/stacking/measure_many.h"

namespace stackabilization {

namespace {

/// Cosine and sine, exact at multiples of a right angle.
struct Turn {
  double cosine, sine;
};

Turn turn(double degrees) {
  const double quarters = std::floor(degrees / 90), rest = (degrees - 90 * quarters) * std::numbers::pi / 180;
  const double c = std::cos(rest), s = std::sin(rest);
  switch (static_cast<int>(quarters) % 4) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

MapSample sample_at(double theta, double phi) {
  const Turn polar = turn(theta), around = turn(phi);
  const Eigen::Vector3d direction(polar.sine * around.cosine, polar.sine * around.sine, polar.cosine);
  return {(direction.array() + 0.0).matrix(), theta, phi, 0, 0};
}

std::vector<MapSample> directions(double step) {
  const int rings = static_cast<int>(std::ceil(90 / step));
  std::vector<MapSample> samples = {sample_at(0, 0)};
  for (int ring = 1; ring <= rings; ++ring) {
    const double theta = 90.0 * ring / rings;
    // A multiple of four, so that every ring meets the planes of the axes.
    const int count = 4 * static_cast<int>(std::ceil(90 * turn(theta).sine / step));
    for (int i = 0; i < count; ++i) samples.push_back(sample_at(theta, 360.0 * i / count));
  }
  return samples;
}

}  // namespace

StackabilityMap stackability_map(const StackabilitySolver& solver, const MapOptions& options) {
  if (!(options.step_degrees >= 0.1) || options.step_degrees > 90)
    throw UsageError("the step of a map must be between 0.1 and 90 degrees");
  if (!(solver.box_volume() > 0)) throw UsageError("a map needs a shape whose stackability is defined");
  StackabilityMap map;
  map.step_degrees = options.step_degrees;
  map.samples = directions(options.step_degrees);
  Points asked(static_cast<Eigen::Index>(map.samples.size()), 3);
  for (std::size_t i = 0; i < map.samples.size(); ++i)
    asked.row(static_cast<Eigen::Index>(i)) = map.samples[i].direction.transpose();
  const std::vector<Stackability> measured =
      measure_many(solver, asked, {options.progress, options.cancelled});
  map.cancelled = measured.size() < map.samples.size();
  map.samples.resize(measured.size());
  for (std::size_t i = 0; i < measured.size(); ++i) {
    map.samples[i].f_max_over_height = measured[i].f_max / measured[i].extent;
    map.samples[i].stackability = measured[i].value;
  }
  return map;
}

}  // namespace stackabilization
