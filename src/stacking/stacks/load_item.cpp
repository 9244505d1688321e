#include "stackabilization/stacking/load_item.h"

#include <algorithm>
#include <cmath>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization {

namespace {

std::int64_t steps_of(double length, double step) {
  constexpr double max_steps = 9007199254740992;  // 2^53: beyond, doubles skip whole numbers
  const double steps = length / step;
  if (!(steps <= max_steps))
    throw UsageError("the unit of whole numbers is too small for a length of the shape");
  return static_cast<std::int64_t>(std::ceil(steps - tolerance::relative * std::max(1.0, steps)));
}

}  // namespace

LoadItem load_item(const StackabilitySolver& solver, const Direction& direction, double step) {
  if (!(step > 0)) throw UsageError("the unit of whole numbers expects a length above 0");
  const Stackability measured = solver.measure(direction);
  const OrientedBox box = solver.hull().box_along(direction);
  Eigen::Index along = 0;
  (box.axes.transpose() * direction.unit()).cwiseAbs().maxCoeff(&along);
  const double a = 2 * box.half_extents[(along + 1) % 3], b = 2 * box.half_extents[(along + 2) % 3];
  LoadItem item;
  item.length = steps_of(std::max(a, b), step);
  item.width = steps_of(std::min(a, b), step);
  item.increment = steps_of(measured.f_max, step);
  item.height = std::max(steps_of(measured.extent, step), item.increment);
  item.nesting_height = item.height - item.increment;
  return item;
}

}  // namespace stackabilization
