#include "improvement/design/best_measured.h"

#include "stackabilization/core/direction.h"
#include "stackabilization/core/errors.h"

namespace stackabilization::detail {

std::optional<Stackability> best_measured(const Shape& shape, StackabilityOptions options,
                                          const std::vector<Eigen::Vector3d>& directions) {
  if (directions.empty()) throw UsageError("there is no direction to stack along");
  options.flat_shapes = FlatShapes::measure;
  const StackabilitySolver solver(shape, options);
  if (!(solver.box_volume() > 0)) return std::nullopt;
  std::optional<Stackability> best;
  for (const Eigen::Vector3d& direction : directions) {
    const Stackability measured = solver.measure(Direction(direction));
    if (!best || measured.value > best->value) best = measured;
  }
  return best;
}

}  // namespace stackabilization::detail
