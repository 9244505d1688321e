#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "mesh/welded_mesh.h"

namespace stackabilization::detail {

/// Walks over the triangles of one part after the other, across common edges. Built from the shape at rest,
/// for all shapes with the same triangles. Safe from any number of threads.
class SurfaceWalk {
 public:
  /// `mesh`: the welded triangles of `shape`. Across an edge with three triangles or more of a part, each
  /// leads to one other.
  SurfaceWalk(const Shape& shape, const WeldedMesh& mesh);

  /// Returns how far `point` is from the surface around the triangle `start`, model units: the distance falls
  /// or stays from one triangle of the walk to the next, and the walk ends after 64 triangles. Never less
  /// than the distance to the part of `start`; more than it where the walk ends at a place that is nearest
  /// only among those around it. Infinity if every triangle of the walk is collapsed. Double precision.
  /// Precondition: `shape` has the triangles of the shape at rest.
  double distance(const Shape& shape, const Eigen::Vector3d& point, std::int32_t start) const;

 private:
  std::vector<std::array<std::int32_t, 3>> neighbours_;  ///< per triangle; -1: none
};

}  // namespace stackabilization::detail
