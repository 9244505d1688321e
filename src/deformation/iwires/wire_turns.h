#pragma once

#include <Eigen/Core>
#include <vector>

#include "deformation/iwires/wire_network.h"

/// Not installed.
namespace stackabilization::detail {

/// The linear map that each wire follows when wire `edited` is turned by `linear`: mirror images by its
/// image; wires parallel to these, and curves in one plane with them, likewise, the nearest one deciding
/// where images disagree; others not at all.
std::vector<Eigen::Matrix3d> spread_turn(const WireNetwork& network, int edited,
                                         const Eigen::Matrix3d& linear);

}  // namespace stackabilization::detail
