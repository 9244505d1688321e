#pragma once

#include <Eigen/Core>

#include "stackabilization/structure/primitive.h"

namespace stackabilization::detail {

/// Length of columns of corrections relative to that of affine motions, whose price is 1: a price of 1 over
/// their square.
inline constexpr double bending_length = 0.3;
inline constexpr double sliding_length = 1;
inline constexpr double corner_length = 0.1;
inline constexpr double radius_length = 0.1;

/// Length of columns that strain or turn a primitive, relative to that of translations: 1, but for parts
/// smaller than a tenth of `diagonal` in proportion to their size, so that screws and feet go along with what
/// they are joined to. Model units.
double strain_length(const Primitive& rest, double diagonal);

/// n x n: exp(-(s_i - s_j)^2 / (2 sigma^2)) over the arc lengths s of the sections at rest, sigma = 0.2 of
/// the whole (paper, section 4.1), around closed curves as well.
Eigen::MatrixXd gaussian_spread(const GeneralizedCylinder& rest);

/// n weights (s_i - s_far) / (s_section - s_far) over the arc lengths s of the sections, of a straight
/// cylinder over their places along its chord: 1 at `section`, 0 at the end that is farther from it along the
/// curve (from the middle: at the last section). Precondition: the curve is open.
Eigen::VectorXd linear_weights(const GeneralizedCylinder& now, int section);

/// Symmetric positive semi-definite matrix K over the control values of a primitive (ControlState::values):
/// an edit that prescribes some of them makes the change of least norm x^T K^+ x. Corners of a cuboid move
/// alone; a change of a cross-section spreads to its neighbours by `gaussian_spread`, that of a radius in
/// proportion to theirs.
Eigen::MatrixXd edit_kernel(const Primitive& rest);

/// B whose columns, all of the same price, span what a solver may do to a primitive: cheap affine motions of
/// the whole (a translation by 1 is a column; of a cuboid strains by 1 over its longest side), dearer smooth
/// bending, and dearest non-affine moves of single corners and changes of radii; all but the translations
/// times `strain`, see strain_length.
Eigen::MatrixXd correction_basis(const Primitive& rest, double strain);

/// 3 x 3n: rotation vector of the rigid motion nearest to small displacements of the centres; no component
/// that they leave undetermined, such as about a straight axis.
Eigen::MatrixXd turning(const GeneralizedCylinder& rest);

}  // namespace stackabilization::detail
