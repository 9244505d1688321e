#include "common/lattice.h"

#include <cmath>
#include <numbers>

namespace stackabilization::experiments {

std::vector<Direction> hemisphere_lattice(int count) {
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<Direction> directions;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (i + 0.5) / count, radius = std::sqrt((1 - z) * (1 + z));
    directions.emplace_back(radius * std::cos(golden_angle * i), radius * std::sin(golden_angle * i), z);
  }
  return directions;
}

}  // namespace stackabilization::experiments
