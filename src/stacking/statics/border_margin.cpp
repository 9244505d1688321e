#include "stacking/statics/border_margin.h"

#include <algorithm>
#include <limits>

#include "mesh/planar.h"

namespace stackabilization::detail {

BorderMargin border_margin(const std::vector<Eigen::Vector2d>& points, double resolution) {
  Eigen::Matrix2Xd columns(2, static_cast<Eigen::Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) columns.col(static_cast<Eigen::Index>(k)) = points[k];
  const std::vector<int> hull = convex_polygon(columns, resolution);
  BorderMargin margin;
  margin.flat = hull.size() < 3;
  double line = std::numeric_limits<double>::infinity();  // of the nearest side, with the origin on the left
  Eigen::Vector2d nearest = columns.col(hull.front());
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const Eigen::Vector2d from = columns.col(hull[k]), side = columns.col(hull[(k + 1) % hull.size()]) - from;
    const double length = side.norm();
    if (!(length > 0)) continue;
    const Eigen::Vector2d axis = side / length, foot = from + std::clamp(-from.dot(axis), 0.0, length) * axis;
    if (foot.squaredNorm() < nearest.squaredNorm()) nearest = foot;
    if (const double distance = cross(axis, -from); distance < line) {
      line = distance;
      margin.outwards = {axis.y(), -axis.x()};
    }
  }
  if (!margin.flat && line >= 0) {
    margin.distance = line;
  } else if (const double distance = nearest.norm(); distance > resolution) {
    margin.distance = -distance;
    margin.outwards = -nearest / distance;
  }
  return margin;
}

}  // namespace stackabilization::detail
