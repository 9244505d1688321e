#pragma once

#include <Eigen/Core>
#include <vector>

#include "stackabilization/structure/structure.h"

namespace stackabilization::detail {

/// Primitives that go along with a mesh which something else deforms. Immutable, safe to share between
/// threads.
class CarriedPrimitives {
 public:
  explicit CarriedPrimitives(const StructuredShape& rest);

  /// One per part: that at rest under the affine map which fits the displacements of the part's vertices best
  /// in the least-squares sense; moved by their mean where the vertices lie in a plane up to
  /// tolerance::relative. Radii follow so that the areas of the cross-sections change as under the map. At
  /// rest to the bit where no vertex of the part moved. `vertices`: n x 3, those of the shape now.
  std::vector<Primitive> at(const Points& vertices) const;

 private:
  struct CarriedPart {
    Primitive primitive;
    std::vector<int> vertices;
    Eigen::Vector3d centre;          ///< mean of the vertices at rest
    Eigen::MatrixXd pseudo_inverse;  ///< 3 x m, of their offsets from it; empty when these lie in a plane
  };
  Points rest_;
  std::vector<CarriedPart> parts_;
};

}  // namespace stackabilization::detail
