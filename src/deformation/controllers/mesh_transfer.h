#pragma once

#include <vector>

#include "deformation/controllers/relation_solver.h"
#include "deformation/controllers/rig.h"
#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// The vertices of a shape bound to its parts. A vertex rides on the part whose triangles use it. Where parts
/// share vertices, those ride on all of them in equal shares, and the share of the other part falls off
/// smoothly, to nothing at 0.15 of the diagonal of the smaller part, measured along the edges: no crack and
/// no step. Vertices that no triangle uses stay. Immutable, safe to share between threads.
class MeshTransfer {
 public:
  MeshTransfer(const Shape& shape, const Rig& rig);

  /// n x 3; the vertices at rest to the bit where no part moved.
  Points vertices(const Rig& rig, const std::vector<Primitive>& now) const;
  /// The same for one vertex, as a weighted sum of riding points.
  std::vector<Rider> riders(int vertex) const;
  const Points& rest() const { return rest_; }

 private:
  struct BoundPart {
    std::vector<int> vertices;
    std::vector<double> shares;
    std::vector<PointBinding> bindings;
  };
  Points rest_;
  std::vector<BoundPart> parts_;
};

}  // namespace stackabilization::detail
