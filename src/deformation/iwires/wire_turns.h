#pragma once

#include <Eigen/Core>
#include <vector>

#include "deformation/iwires/wire_network.h"

// Propagation of the turn of one wire to others.
namespace stackabilization::detail {

/// Computes the linear map of each wire when wire `edited` turns by `linear`. Its mirror images turn by the
/// image of `linear`. Wires parallel to these, and curves in one plane with them, turn likewise; where images
/// disagree, the nearest one decides. All other wires do not turn: their map is the identity.
std::vector<Eigen::Matrix3d> spread_turn(const WireNetwork& network, int edited,
                                         const Eigen::Matrix3d& linear);

}  // namespace stackabilization::detail
