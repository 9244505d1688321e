#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Place where the thickness of the material is measured: two points, one on a triangle and the other on the
/// opposite surface, straight through the material.
struct ThicknessProbe {
  std::int32_t near_triangle = -1, far_triangle = -1;  ///< rows of Shape::triangles
  Eigen::Vector3d near_weights, far_weights;           ///< barycentric weights of the two points
  double at_rest = 0;                                  ///< distance of the two points at rest, model units
};

/// Options of `thickness_probes`.
struct ThicknessOptions {
  /// Number of probes tried, spread over the surface by area; >= 1. Parts without a probe are sampled again
  /// on their own.
  int probes = 2000;
};

/// Finds places where the thickness of a shape can be measured, with rays along the normals of points spread
/// over the surface (surface_samples). Only the shell of a point counts, that is the triangles connected to
/// it through common points: a leg is as thick where it stands in the seat as below it. The material lies on
/// the side on which the ray crosses the shell an odd number of times, whatever the orientation of the
/// triangles. Sheets have no probes. Open shells have none either, unless the rays cross walls on one side
/// only.
///
/// Double precision, crossings decided exactly. The result is the same for any number of threads. Throws
/// UsageError for less than one probe, InputError when `validate(shape)` fails or no triangle has an area.
std::vector<ThicknessProbe> thickness_probes(const Shape& shape, const ThicknessOptions& options = {});

/// Returns the distance of the two points of a probe in a deformed shape, model units. Precondition: `shape`
/// has the triangles of the shape for which the probe was made.
double thickness(const ThicknessProbe& probe, const Shape& shape);

}  // namespace stackabilization
