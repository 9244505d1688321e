#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Result of SurfaceIndex::nearest.
struct SurfacePoint {
  std::int32_t triangle = -1;                       ///< triangle of the point, row of Shape::triangles
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< model units
  double distance = 0;                              ///< distance from the query point, model units
};

/// Nearest-point queries on a surface, in double precision. Built once per shape, safe to share between
/// threads.
class SurfaceIndex {
 public:
  /// Throws InputError when no triangle has a positive area.
  explicit SurfaceIndex(const Shape& shape);
  SurfaceIndex(SurfaceIndex&&) noexcept;
  SurfaceIndex& operator=(SurfaceIndex&&) noexcept;
  ~SurfaceIndex();

  /// Returns the point of the surface that is nearest to `point` (model units).
  SurfacePoint nearest(const Eigen::Vector3d& point) const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

/// Samples of a surface.
struct SurfaceSamples {
  Points points;                        ///< n x 3, model units
  Points normals;                       ///< n x 3 unit normals of the triangles
  std::vector<std::int32_t> triangles;  ///< n rows of Shape::triangles
};

/// Computes `count` samples of equal area: stratified along the triangles in their order, with low
/// discrepancy within a triangle. Deterministic. The samples move with the shape. Throws InputError when no
/// triangle has a positive area.
SurfaceSamples surface_samples(const Shape& shape, int count);

}  // namespace stackabilization
