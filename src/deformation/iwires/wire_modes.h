#pragma once

#include <Eigen/Core>
#include <vector>

#include "stackabilization/deformation/wire_analysis.h"

/// Not installed.
namespace stackabilization::detail {

enum class WireMotion {
  move,   ///< keeps size and direction
  scale,  ///< changes the size
  turn,   ///< changes the direction
};

/// What an edit does to a wire.
struct WireEdit {
  int wire = 0;
  WireMotion motion = WireMotion::move;
  Eigen::Vector3d by = Eigen::Vector3d::Zero();          ///< of move
  double factor = 1;                                     ///< of scale, about the wire's centre
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();  ///< of turn, about the wire's centre
};

/// A way for a wire to change: p -> p + q matrix (p - centre), the unknown q a length.
struct WireMode {
  int variable;
  Eigen::Matrix3d matrix;
};

/// The unknowns of a problem of least squares over all wires: rows 3 k to 3 k + 2 the displacement of the
/// centre of wire k, then the q of modes, which wires of equal size share.
struct WireModes {
  std::vector<std::vector<WireMode>> of_wire;
  int variables = 0;
};

/// What the forms of wires leave open: to a segment its length, to a circle its radius, to a planar curve any
/// linear map of its plane, to a spatial one any. `axes`: directions and normals of the wires, unit. A circle
/// that `edit` scales shares its radius with its mirror images only, and in turns all wires do so.
WireModes wire_modes(const WireStructure& structure, const std::vector<Eigen::Vector3d>& axes,
                     const WireEdit& edit);

}  // namespace stackabilization::detail
