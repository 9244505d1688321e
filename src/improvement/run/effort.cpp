#include "stackabilization/improvement/effort.h"

#include <algorithm>
#include <limits>

#include "stackabilization/core/errors.h"
#include "stackabilization/mesh/boxes.h"

namespace stackabilization {

namespace {

/// Work of effort 1, and cost of a design, in microseconds of a processor of 2.6 GHz. Fitted to the elapsed
/// times of `improve` with one thread on the shipped models (4,000 to 5,000 triangles) and on others of 1,000
/// to 50,000 triangles. Besides the triangles the corners of the hull count, since every design needs the
/// smallest box around its hull; those of a large one in part only.
constexpr double design_work = 36e6;
constexpr double design_cost = 500, triangle_cost = 1, hull_point_cost = 36, part_cost = 220;

/// Work of effort 1, and cost of a direction. Fitted to `search`.
constexpr double direction_work = 60e6;
constexpr double direction_cost = 500, direction_triangles = 10000;  ///< triangles that double the cost

void require_effort(double effort) {
  if (!(effort > 0)) throw UsageError("the effort of a search must be above 0");
}

}  // namespace

double designs_of_effort(double effort, const RestShape& rest) {
  require_effort(effort);
  const auto triangles = static_cast<double>(rest.shape().triangle_count());
  const auto hull_points = static_cast<double>(std::min(rest.hull().points().rows(), large_hull));
  const auto parts = static_cast<double>(rest.shape().part_count());
  return effort * design_work /
         (design_cost + triangles * triangle_cost + hull_points * hull_point_cost + parts * part_cost);
}

std::int64_t directions_of_effort(double effort, const Shape& shape) {
  require_effort(effort);
  constexpr auto most = std::numeric_limits<std::int64_t>::max();
  const auto triangles = static_cast<double>(shape.triangle_count());
  const double directions =
      effort * direction_work / (direction_cost * (1 + triangles / direction_triangles));
  if (!(directions < static_cast<double>(most))) return most;
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(directions));
}

}  // namespace stackabilization
