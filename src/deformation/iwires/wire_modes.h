#pragma once

#include <Eigen/Core>
#include <vector>

#include "stackabilization/deformation/wire_analysis.h"

// Degrees of freedom of wires: the unknowns of wire_propagation.h.
namespace stackabilization::detail {

/// Kinds of edits of a wire.
enum class WireMotion {
  move,   ///< translation: keeps size and direction
  scale,  ///< scaling: changes the size
  turn,   ///< rotation: changes the direction
};

/// An edit of one wire.
struct WireEdit {
  int wire = 0;
  WireMotion motion = WireMotion::move;
  Eigen::Vector3d by = Eigen::Vector3d::Zero();          ///< translation of a move, model units
  double factor = 1;                                     ///< factor of a scaling about the wire's centre
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();  ///< linear map of a turn about the wire's centre
};

/// A degree of freedom of a wire: p -> p + q matrix (p - centre), where the unknown q is a length.
struct WireMode {
  int variable;  ///< index of q among the unknowns
  Eigen::Matrix3d matrix;
};

/// The unknowns of the least-squares problem over all wires. Unknowns 3 k to 3 k + 2 are the displacement of
/// the centre of wire k. The q of the modes follow; wires of equal size share theirs.
struct WireModes {
  std::vector<std::vector<WireMode>> of_wire;
  int variables = 0;
};

/// Computes the modes that the forms of the wires allow: of a segment its length, of a circle its radius, of
/// a planar curve any linear map of its plane, of a spatial curve any linear map. `axes`: unit directions and
/// normals of the wires. Wires of equal size share an unknown, with two exceptions: a circle that `edit`
/// scales shares its radius with its mirror images only, and in turns every wire shares its size with its
/// mirror images only.
WireModes wire_modes(const WireStructure& structure, const std::vector<Eigen::Vector3d>& axes,
                     const WireEdit& edit);

}  // namespace stackabilization::detail
