#pragma once

#include <cstdint>
#include <vector>

#include "stackabilization/shape/shape.h"

namespace stackabilization {

/// A place where material is measured: from a point on a triangle straight through the material to the
/// surface on its other side.
struct ThicknessProbe {
  std::int32_t near_triangle = -1, far_triangle = -1;
  Eigen::Vector3d near_weights, far_weights;  ///< barycentric, of the two points
  double at_rest = 0;                         ///< distance of the two points, model units
};

struct ThicknessOptions {
  int probes = 2000;  ///< spread over the surface by area, at least one per part that has any
};

/// Places where the material of a shape can be measured. Shells that are open, or whose far side is not
/// found, have none there. Deterministic. Throws InputError when `shape` is invalid.
std::vector<ThicknessProbe> thickness_probes(const Shape& shape, const ThicknessOptions& options = {});

/// Distance of the two points of a probe in a deformed shape, model units.
double thickness(const ThicknessProbe& probe, const Shape& shape);

}  // namespace stackabilization
