#pragma once

#include <Eigen/Core>
#include <vector>

#include "stackabilization/structure/structure.h"

namespace stackabilization::detail {

/// Primitives that follow a mesh deformed by other means. Immutable, safe to share between threads.
class CarriedPrimitives {
 public:
  explicit CarriedPrimitives(const StructuredShape& rest);

  /// Returns one primitive per part for `vertices` (n x 3, the deformed shape). A primitive follows the
  /// affine map that fits the displacements of the vertices of its part best in the least-squares sense.
  /// Where these vertices lie in a plane, up to tolerance::relative, it is moved by their mean displacement.
  /// Radii change so that the areas of the cross-sections change as under the map. A primitive is exactly the
  /// one at rest where no vertex of its part moved.
  std::vector<Primitive> at(const Points& vertices) const;

 private:
  struct CarriedPart {
    Primitive primitive;
    std::vector<int> vertices;
    Eigen::Vector3d centre;  ///< mean of the vertices at rest
    /// 3 x m, of the offsets of the vertices from `centre`; empty where these lie in a plane.
    Eigen::MatrixXd pseudo_inverse;
  };
  Points rest_;
  std::vector<CarriedPart> parts_;
};

}  // namespace stackabilization::detail
