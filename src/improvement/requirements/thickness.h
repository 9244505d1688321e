#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// A place where material is measured: from a point on a triangle straight through the material to the
/// surface on its other side.
struct ThicknessProbe {
  std::int32_t near_triangle = -1, far_triangle = -1;  ///< rows of Shape::triangles
  Eigen::Vector3d near_weights, far_weights;           ///< barycentric, of the two points
  double at_rest = 0;                                  ///< distance of the two points, model units
};

/// How many probes `thickness_probes` tries.
struct ThicknessOptions {
  int probes = 2000;  ///< tried, spread over the surface by area; >= 1. Parts that get none are tried apart
};

/// Places where the material of a shape can be measured, by rays along the normals of points spread over the
/// surface (surface_samples). Only the shell of a point counts, that is the triangles that hang together with
/// it through common points: a leg is as thick where it stands in the seat as below it. The side of the
/// material is the one on which the shell is crossed an odd number of times, whichever way its triangles are
/// turned. Sheets have no material, and where a shell is open there is none to be found either, unless the
/// rays meet walls of it on one side only.
///
/// Double precision, crossings decided exactly; the same for any number of threads. Throws UsageError for
/// less than one probe, InputError when `validate(shape)` fails or no triangle has an area.
std::vector<ThicknessProbe> thickness_probes(const Shape& shape, const ThicknessOptions& options = {});

/// Distance of the two points of a probe in a deformed shape, model units. Precondition: `shape` has the
/// triangles of the one that the probe was made for.
double thickness(const ThicknessProbe& probe, const Shape& shape);

}  // namespace stackabilization
