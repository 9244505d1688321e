#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mesh/welded_mesh.h"
#include "stackabilization/deformation/surface_model.h"

namespace stackabilization::detail {

/// What a handle of the surface model takes hold of.
struct HeldSurface {
  std::vector<std::int32_t> places;  ///< ascending rows of WeldedMesh::points, at least one
  Eigen::VectorXd
      weights;  ///< per place, summing to one: their mean is the centre, also when they have moved
};

/// The handles of the surface model, as its documentation says.
class SurfaceHandles {
 public:
  /// Throws UsageError for options outside their ranges.
  SurfaceHandles(const Shape& shape, const WeldedMesh& places, const SurfaceModelOptions& options);

  std::vector<Handle> all() const;
  /// Throws UsageError when there is no such handle.
  HeldSurface held(const Handle& handle) const;
  /// Unit vector along which the sections follow each other.
  const Eigen::Vector3d& axis() const { return axis_; }

 private:
  HeldSurface weighted(std::vector<std::int32_t> places) const;
  HeldSurface around(int vertex) const;

  std::vector<std::vector<std::int32_t>> parts_, sections_;
  std::vector<std::int32_t> place_of_vertex_, vertex_of_place_;
  Points points_;
  Eigen::VectorXd areas_;  ///< per place, a third of its triangles
  Eigen::Vector3d axis_;
  double radius_ = 0;  ///< of point handles, model units
};

}  // namespace stackabilization::detail
