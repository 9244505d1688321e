#pragma once

#include <Eigen/Core>
#include <map>
#include <utility>
#include <vector>

#include "stackabilization/core/shape.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization::detail {

/// Vertices with shares.
using SharedVertices = std::vector<std::pair<int, double>>;

/// A seam at which one part of a connected surface is attached to another one, its carrier, in smooth
/// designs.
struct CarriedSeam {
  int attached = 0, carrier = 0;
  Eigen::Vector3d point;  ///< mean of the vertices of the seam at rest
  Eigen::Vector3d axis;   ///< from there into the attached part, along it; 0 where it has no end there
  /// Vertices around the seam, ascending, with the share that they make of what the attached part moves
  /// against the carrier at `point`: a joint that slides takes the surface of the carrier along. Those of the
  /// attached part are the ones that follow the carrier.
  SharedVertices around;
  /// Vertices of the attached part near the seam, with the share in which they follow the carrier along
  /// `axis`: the end of a leg that leans is trimmed to the top.
  SharedVertices trimmed;
};

/// How the vertices of a shape follow its parts.
struct VertexShares {
  std::vector<std::map<int, double>> of_vertex;  ///< parts with their shares, whose sum is 1
  std::vector<CarriedSeam> seams;                ///< of smooth designs
};

/// Computes how vertices follow the parts of a shape, as described with MeshTransfer. `smooth`: the structure
/// of a smooth design, null for others.
VertexShares vertex_shares(const Shape& shape, const Structure* smooth);

}  // namespace stackabilization::detail
