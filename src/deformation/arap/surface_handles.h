#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mesh/welded_mesh.h"
#include "stackabilization/deformation/surface_model.h"

namespace stackabilization::detail {

/// Welded vertices that a handle of the surface model holds.
struct HeldSurface {
  std::vector<std::int32_t> places;  ///< ascending rows of WeldedMesh::points, at least one
  Eigen::VectorXd
      weights;  ///< one per place, sum 1; the weighted mean of the places is the centre, at rest and later
};

/// Handles of the surface model. See surface_model.h for their definition.
class SurfaceHandles {
 public:
  /// Throws UsageError for options outside their ranges.
  SurfaceHandles(const Shape& shape, const WeldedMesh& places, const SurfaceModelOptions& options);

  /// Returns the shape, the parts, the sections with vertices, and one point per welded vertex.
  std::vector<Handle> all() const;
  /// Returns the vertices that `handle` holds. Throws UsageError when there is no such handle.
  HeldSurface held(const Handle& handle) const;
  /// Returns the unit main axis, along which the sections are numbered.
  const Eigen::Vector3d& axis() const { return axis_; }

 private:
  HeldSurface weighted(std::vector<std::int32_t> places) const;
  HeldSurface around(int vertex) const;

  std::vector<std::vector<std::int32_t>> parts_, sections_;
  std::vector<std::int32_t> place_of_vertex_, vertex_of_place_;
  Points points_;
  Eigen::VectorXd areas_;  ///< per place, a third of the area of its triangles, model units squared
  Eigen::Vector3d axis_;
  double radius_ = 0;  ///< radius of point handles, model units
};

}  // namespace stackabilization::detail
