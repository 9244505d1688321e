#pragma once

#include <Eigen/Core>
#include <limits>

#include "mesh/surface_index.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/mesh/boxes.h"
#include "stackabilization/structure/primitive.h"

namespace stackabilization::detail {

/// Cached acceleration structures of one part: nearest-point index and area-uniform samples. It refers to the
/// shape, which must outlive it.
struct FitSurface {
  /// Throws InputError when no triangle has a positive area.
  explicit FitSurface(const Shape& part);

  const Shape& shape;
  SurfaceIndex index;
  SurfaceSamples samples;
};

/// Computes the distance from a point, inside or outside, to the surface of a box, model units.
double distance_to_surface(const OrientedBox& box, const Eigen::Vector3d& point);

/// Computes the distance from a point, inside or outside, to the surface of a cylinder, model units. The
/// surface consists of the cone frusta between neighbouring circles, and of the two end discs of an open
/// cylinder.
double distance_to_surface(const GeneralizedCylinder& cylinder, const Eigen::Vector3d& point);

/// Computes the root mean square distance from the surface of the part to the surface of the box, model
/// units.
double distance_to_surface(const OrientedBox& box, const FitSurface& part);

/// Computes the two-sided distance of the surfaces, model units: the root of the mean of two mean squares,
/// part to primitive and primitive to part, each weighted by area. A one-sided distance would rate a frame as
/// well represented by the box around its hole.
double fit_error(const OrientedBox& box, const FitSurface& part);
/// Computes the same distance for a cylinder. The result may be infinite when the distance is at least
/// `enough`; the measurement then stops early.
double fit_error(const GeneralizedCylinder& cylinder, const FitSurface& part,
                 double enough = std::numeric_limits<double>::infinity());

}  // namespace stackabilization::detail
