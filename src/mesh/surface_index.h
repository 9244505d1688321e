#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// A point of a surface, as SurfaceIndex::nearest finds it.
struct SurfacePoint {
  std::int32_t triangle = -1;                       ///< that holds it, row of Shape::triangles
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< model units
  double distance = 0;                              ///< from the point asked about, model units
};

/// Nearest points of a surface; double precision. Built once per shape, safe to share between threads.
class SurfaceIndex {
 public:
  /// Throws InputError when no triangle has a positive area.
  explicit SurfaceIndex(const Shape& shape);
  SurfaceIndex(SurfaceIndex&&) noexcept;
  SurfaceIndex& operator=(SurfaceIndex&&) noexcept;
  ~SurfaceIndex();

  /// The point of the surface that is nearest to `point` (model units).
  SurfacePoint nearest(const Eigen::Vector3d& point) const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

/// Points spread over a surface.
struct SurfaceSamples {
  Points points;                        ///< n x 3
  Points normals;                       ///< n x 3 unit normals of their triangles
  std::vector<std::int32_t> triangles;  ///< n
};

/// `count` points, each standing for the same area: stratified along the triangles in their order,
/// low-discrepancy within them. Deterministic, and moves with the shape. Throws InputError when no triangle
/// has a positive area.
SurfaceSamples surface_samples(const Shape& shape, int count);

}  // namespace stackabilization
