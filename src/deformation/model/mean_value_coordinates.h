#pragma once

#include <Eigen/Core>

#include "stackabilization/core/shape.h"
#include "stackabilization/structure/primitive.h"

namespace stackabilization {

/// 8 x n weights, one column per point, in the order of Cuboid::corners.
using CornerWeights = Eigen::Matrix<double, 8, Eigen::Dynamic>;

/// Computes the mean value coordinates (Ju, Schaefer and Warren 2005) of `point` in the cube [-1, 1]^3.
///
/// Each square of the cage counts with both of its triangulations, one half each, so the weights have all the
/// symmetries of the cube. On the faces the weights are the mean of the barycentric coordinates of the two
/// triangulations, on the edges they are linear, and at the corners they are 0 and 1: the limits of the
/// formula. The weights are positive inside the cube, sum to one and reproduce the point, up to rounding.
///
/// The formula loses digits within tolerance::relative of the plane of a face, and outside of [-2, 2]^3.
/// There the weights are those of the nearest point of the plane or of that cube plus a linear term. Outside
/// of [-2, 2]^3 they therefore extrapolate affinely.
Eigen::Matrix<double, 8, 1> cube_coordinates(const Eigen::Vector3d& point);

/// Computes `cube_coordinates` of n points in the frame in which the box `rest` is that cube.
///
/// Mean value coordinates are not invariant under affine maps, so the normalisation of the box is a choice.
/// With it they are as well conditioned for a plank as for a cube, and keep linear precision. Along an axis
/// in which the box has no extent, points count as lying on it. Precondition: `rest` is a box or a
/// parallelepiped.
CornerWeights mean_value_coordinates(const Cuboid& rest, const Points& points);

}  // namespace stackabilization
