#include "common/lattice.h"

#include <cmath>
#include <numbers>

#include "common/random.h"

namespace stackabilization::experiments {
namespace {

/// The point of the unit sphere at this height and longitude.
Direction at(double z, double longitude) {
  const double radius = std::sqrt((1 - z) * (1 + z));
  return {radius * std::cos(longitude), radius * std::sin(longitude), z};
}

}  // namespace

std::vector<Direction> hemisphere_lattice(int count) {
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<Direction> directions;
  for (int i = 0; i < count; ++i) directions.push_back(at(1 - (i + 0.5) / count, golden_angle * i));
  return directions;
}

std::vector<Direction> random_directions(int count, unsigned seed) {
  Random random(seed);
  std::vector<Direction> directions;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - random.uniform();  // the area of a zone is its height
    directions.push_back(at(z, 2 * std::numbers::pi * random.uniform()));
  }
  return directions;
}

}  // namespace stackabilization::experiments
