#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "deformation/iwires/wire_modes.h"
#include "deformation/iwires/wire_network.h"

/// Not installed.
namespace stackabilization::detail {

/// Where wires are: the map that takes each of them from rest to now.
using WireMaps = std::vector<Eigen::Affine3d>;

/// What may not move while wires are propagated.
struct WireHolds {
  std::vector<std::int32_t> vertices;  ///< of the shape, ascending: wires through them stay there
  std::optional<Eigen::Vector3d>
      height;  ///< unit; wires do not move along it where they reach highest and lowest
};

/// Wires after an edit, and the relation that is farthest from holding.
struct PropagatedWires {
  WireMaps maps;
  /// Distance by which it is missed over the distance that is allowed: WireNetwork::tolerance for junctions
  /// and planes, tolerance::relation for symmetries and what is held. The edit was possible when this is at
  /// most 1.
  double excess = 0;
  double missed_by = 0;  ///< that distance, model units
  std::string missed;    ///< what would happen to the relation, a clause
};

/// Carries an edit of one wire on to all others so that their properties and relations hold.
///
/// Every wire may move, and change in the ways that its form leaves open: a segment its length, a circle its
/// radius, a planar curve by a linear map of its plane, a spatial one by any. So forms, directions and
/// normals are kept by construction, as are equal lengths (one unknown for a group). Junctions, common planes
/// and symmetries are linear equations between these unknowns. Among all solutions the one is taken that
/// keeps wires where they are and curved ones as large and round as they are, and the offsets of linked ones
/// (least squares); wires that would be flattened or turned inside out keep their size instead.
///
/// A turn goes first to the mirror images, from them to parallel wires and to curves of the same plane; when
/// the equations cannot hold so, it goes to all wires.
PropagatedWires propagated(const WireNetwork& network, const WireMaps& now, const WireEdit& edit,
                           const WireHolds& holds);

}  // namespace stackabilization::detail
