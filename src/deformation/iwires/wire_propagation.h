#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "deformation/iwires/wire_modes.h"
#include "deformation/iwires/wire_network.h"
#include "stackabilization/deformation/refusal.h"

// Propagation of an edit from one wire to all others.
namespace stackabilization::detail {

/// Positions of the wires: the map of each wire from rest to its current position.
using WireMaps = std::vector<Eigen::Affine3d>;

/// Points and heights that must not change while an edit propagates.
struct WireHolds {
  /// Ascending vertices of the shape; wires through them keep them there.
  std::vector<std::int32_t> vertices;
  std::optional<Eigen::Vector3d>
      height;  ///< unit direction; the highest and lowest points of wires do not move along it
};

/// Wires after an edit, and the relation with the largest violation.
struct PropagatedWires {
  WireMaps maps;
  /// Violation of this relation divided by its tolerance: WireNetwork::tolerance for junctions and planes,
  /// tolerance::relation of the diagonal for symmetries and held points. The edit was possible when this is
  /// at most 1.
  double excess = 0;
  double violation = 0;  ///< violation of this relation, model units
  Refusal missed;        ///< refusal for this violation, without its amount
};

/// Propagates an edit of one wire to all others such that their properties and relations hold.
///
/// Every wire may move, and change in the ways that its form allows: a segment its length, a circle its
/// radius, a planar curve by a linear map of its plane, a spatial curve by any linear map. Forms, directions,
/// normals and equal lengths (one unknown for a group) are therefore kept by construction. Junctions, common
/// planes and symmetries are linear equations of these unknowns. Of all solutions the function returns the
/// least-squares solution that keeps the wires at their positions, the size and roundness of curved wires,
/// and the offsets of linked wires. Wires that would be flattened or turned inside out keep their size
/// instead.
///
/// A turn propagates first to the mirror images, from them to parallel wires and to curves of the same plane.
/// When the equations cannot hold then, the turn applies to all wires.
PropagatedWires propagate(const WireNetwork& network, const WireMaps& now, const WireEdit& edit,
                          const WireHolds& holds);

}  // namespace stackabilization::detail
