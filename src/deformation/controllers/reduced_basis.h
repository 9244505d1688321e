#pragma once

#include <Eigen/Core>

#include "stackabilization/deformation/controller_model.h"
#include "stackabilization/structure/primitive.h"

namespace stackabilization::detail {

// Column scales of the reduced basis; cost of a mode = 1 / scale^2. Dimensionless. Affine motions have scale
// 1 and cost 1.
inline constexpr double bending_scale = 0.3;  ///< smooth bending of a generalized cylinder
inline constexpr double sliding_scale = 1;    ///< slides of sections along a straight cylinder
inline constexpr double corner_scale = 0.1;   ///< non-affine moves of the corners of a cuboid
inline constexpr double radius_scale = 0.1;   ///< changes of radii

/// Computes the column scale of the modes that strain or turn a primitive, relative to its translations.
/// Dimensionless. The scale is 1 for parts of at least a tenth of `diagonal` (model units), and proportional
/// to their size for smaller parts: screws and feet move with the parts that they are joined to.
double strain_scale(const Primitive& rest, double diagonal);

/// Computes the n x n matrix exp(-(s_i - s_j)^2 / (2 sigma^2)) of the arc lengths s of the sections at rest,
/// with sigma = 0.2 of the total length (paper, section 4.1). On closed curves s_i - s_j is the shorter way
/// around.
Eigen::MatrixXd gaussian_spread(const GeneralizedCylinder& rest);

/// Computes the n weights (s_i - s_far) / (s_section - s_far): 1 at `section`, and 0 at the end of the curve
/// that is farther from it (from the middle: the last section). s is the arc length of the sections; for a
/// straight cylinder, s is their position along the chord. Precondition: the curve is open.
Eigen::VectorXd linear_weights(const GeneralizedCylinder& now, int section);

/// Computes the symmetric positive semi-definite kernel K of the control values of a primitive
/// (ControlState::values). An edit that prescribes some values makes the change x of least norm x^T K^+ x.
/// Corners of a cuboid move independently. A change of a cross-section spreads to its neighbours by
/// `gaussian_spread`. A change of a radius spreads in proportion to the radii of the neighbours.
Eigen::MatrixXd edit_kernel(const Primitive& rest);

/// Computes the basis B of the corrections that a solver may apply to a primitive. A correction B y costs
/// |y|^2: all columns have the same cost, and longer columns are cheaper motions. From cheap to expensive:
///
/// * affine motions of the whole primitive: a translation by 1 is a column; equal strains cost the same: in
///   that of a cuboid along an axis the corners move by its side over the longest side, in that of a
///   generalized cylinder the centres by their root mean square along the axis over the largest one;
/// * smooth bending of a generalized cylinder;
/// * non-affine moves of single corners of a cuboid, and changes of radii.
///
/// With Following::smooth, only affine motions, and one change of all radii in proportion.
///
/// All columns except translations are multiplied by `strain`, see strain_scale.
Eigen::MatrixXd reduced_basis(const Primitive& rest, double strain, Following following = Following::free);

/// Computes the 3 x 3n matrix that maps small displacements of the n centres to the rotation vector of the
/// nearest rigid motion. Components that the centres leave undetermined, such as rotation about a straight
/// axis, are 0.
Eigen::MatrixXd turning(const GeneralizedCylinder& rest);

}  // namespace stackabilization::detail
