#include "stacking/direction/direction_cell.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/angles.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {
namespace {

/// Where a cell is cut. Not in the middle: the borders of cells would fall on the symmetry planes of shapes,
/// where S often jumps.
constexpr double first_share = 0.47;

}  // namespace

Eigen::Vector3d DirectionCell::through(double x, double y) const {
  Eigen::Vector3d direction;
  direction[axis] = 1;
  direction[(axis + 1) % 3] = x;
  direction[(axis + 2) % 3] = y;
  return direction;
}

std::array<Eigen::Vector3d, 4> DirectionCell::corners() const {
  return {through(x_low, y_low), through(x_high, y_low), through(x_low, y_high), through(x_high, y_high)};
}

double DirectionCell::radius() const {
  const Eigen::Vector3d from = middle();
  double largest = 0;
  for (const Eigen::Vector3d& corner : corners()) largest = std::max(largest, angle_between(from, corner));
  return largest * (1 + tolerance::product_rounding) + tolerance::product_rounding;
}

double DirectionCell::min_length() const {
  const double x = std::clamp(0.0, x_low, x_high), y = std::clamp(0.0, y_low, y_high);
  return std::sqrt(1 + x * x + y * y) * (1 - tolerance::product_rounding);
}

std::array<DirectionCell, 2> DirectionCell::halves() const {
  std::array<DirectionCell, 2> result = {*this, *this};
  if (x_high - x_low >= y_high - y_low)
    result[0].x_high = result[1].x_low = x_low + first_share * (x_high - x_low);
  else
    result[0].y_high = result[1].y_low = y_low + first_share * (y_high - y_low);
  return result;
}

}  // namespace stackabilization::detail
