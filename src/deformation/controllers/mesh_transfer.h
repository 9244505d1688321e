#pragma once

#include <vector>

#include "deformation/controllers/relation_solver.h"
#include "deformation/controllers/rig.h"
#include "deformation/controllers/vertex_shares.h"
#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// Binds the vertices of a shape to its parts. A vertex is bound to the part whose triangles use it. A vertex
/// that several parts share is bound to all of them with equal weights. Around the shared vertices each part
/// also carries vertices of the other part. Their weight decreases smoothly with the distance along the
/// edges, to zero at 0.15 of the diagonal of the smaller part. The deformed mesh therefore has no cracks and
/// no steps. In smooth designs it is zero at 0.03 of the diagonal; and of two parts that meet at the end of
/// the one and at a side of the other, a rail and a leg, the shared vertices follow the other, its carrier,
/// so that a leg keeps its flat sides. Where such a seam slides on its carrier, it takes the surface of the
/// carrier along, less with the distance along the edges, and not at 0.2 of the diagonal. Vertices that no
/// triangle uses do not move. Immutable, safe to share between threads.
class MeshTransfer {
 public:
  MeshTransfer(const Shape& shape, const Rig& rig, Following following = Following::free);

  /// Returns the n x 3 vertices for the primitives `now`. Where no part moved, the vertices equal those at
  /// rest bit for bit.
  Points vertices(const Rig& rig, const std::vector<Primitive>& now) const;
  /// Returns the weighted bound points whose sum is the position of vertex `vertex`; of CarriedSeam::trimmed,
  /// while the attached part does not turn.
  std::vector<BoundPoint> bound_points(int vertex) const;
  /// Returns the n x 3 vertices at rest.
  const Points& rest() const { return rest_; }

 private:
  struct BoundPart {
    std::vector<int> vertices;
    std::vector<double> shares;
    std::vector<PointBinding> bindings;
  };
  /// CarriedSeam, bound to both parts.
  struct BoundSeam {
    CarriedSeam seam;
    PointBinding point_on_attached, point_on_carrier;
    PointBinding tip_on_attached;                       ///< of CarriedSeam::axis
    std::vector<PointBinding> on_attached, on_carrier;  ///< of CarriedSeam::trimmed
  };
  Points rest_;
  std::vector<BoundPart> parts_;
  std::vector<BoundSeam> seams_;
};

}  // namespace stackabilization::detail
