#include "stackabilization/improvement/effort.h"

#include <algorithm>
#include <limits>

#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

/// Work of effort 1, and cost of a design and of a direction, in microseconds of a processor of 2 GHz. Fitted
/// to `improve` and `search` on the shipped models (4,000 to 5,000 triangles) and on meshes of 20,000
/// triangles. Besides the triangles the corners of the hull count, up to a number, since every design needs
/// the smallest box around its hull.
constexpr double work = 60e6;
constexpr double design_cost = 1000, triangle_cost = 2.2, hull_point_cost = 160, part_cost = 400;
constexpr double max_hull_points = 1000;  ///< of a larger hull, a part is searched for the box
constexpr double direction_cost = 500, direction_triangles = 10000;  ///< triangles that double the cost

void require_effort(double effort) {
  if (!(effort > 0)) throw UsageError("the effort of a search must be above 0");
}

}  // namespace

double designs_of_effort(double effort, const RestShape& rest) {
  require_effort(effort);
  const auto triangles = static_cast<double>(rest.shape().triangle_count());
  const double hull_points = std::min(static_cast<double>(rest.hull().points().rows()), max_hull_points);
  const auto parts = static_cast<double>(rest.shape().part_count());
  return effort * work /
         (design_cost + triangles * triangle_cost + hull_points * hull_point_cost + parts * part_cost);
}

std::int64_t directions_of_effort(double effort, const Shape& shape) {
  require_effort(effort);
  constexpr auto most = std::numeric_limits<std::int64_t>::max();
  const auto triangles = static_cast<double>(shape.triangle_count());
  const double directions = effort * work / (direction_cost * (1 + triangles / direction_triangles));
  if (!(directions < static_cast<double>(most))) return most;
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(directions));
}

}  // namespace stackabilization
