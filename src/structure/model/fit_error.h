#pragma once

#include <Eigen/Core>
#include <limits>

#include "mesh/surface_index.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/mesh/boxes.h"
#include "stackabilization/structure/primitive.h"

namespace stackabilization::detail {

/// A part with what every fit asks of it again and again. Refers to the shape it was made of.
struct FitSurface {
  /// Throws InputError when no triangle has a positive area.
  explicit FitSurface(const Shape& part);

  const Shape& shape;
  SurfaceIndex index;
  SurfaceSamples samples;
};

/// Distance of a point, inside or outside, from the surface of a box, model units.
double distance_to_surface(const OrientedBox& box, const Eigen::Vector3d& point);

/// Distance of a point, inside or outside, from the cone frusta between neighbouring circles and from the two
/// end discs of an open cylinder, model units.
double distance_to_surface(const GeneralizedCylinder& cylinder, const Eigen::Vector3d& point);

/// Root mean square distance from the surface of the part to the box's, model units.
double distance_to_surface(const OrientedBox& box, const FitSurface& part);

/// Two-sided distance of the surfaces, model units: root of the mean of both mean squares, part to primitive
/// and primitive to part, both by area. One side alone would call a frame well held by the box around its
/// hole. Of a cylinder that is off by `enough` or more it may be infinite: no more of it was measured.
double fit_error(const OrientedBox& box, const FitSurface& part);
double fit_error(const GeneralizedCylinder& cylinder, const FitSurface& part,
                 double enough = std::numeric_limits<double>::infinity());

}  // namespace stackabilization::detail
