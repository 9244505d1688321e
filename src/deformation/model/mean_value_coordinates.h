#pragma once

#include <Eigen/Core>

#include "stackabilization/core/shape.h"
#include "stackabilization/structure/primitive.h"

namespace stackabilization {

/// 8 x n, one column of weights per point, in the order of Cuboid::corners.
using CornerWeights = Eigen::Matrix<double, 8, Eigen::Dynamic>;

/// Mean value coordinates (Ju, Schaefer and Warren 2005) of `point` in the cube [-1, 1]^3.
///
/// Each square of the cage counts with both of its triangulations, one half each, so that the weights have
/// all the symmetries of the cube. On the faces they are the mean of the barycentric coordinates of the two
/// triangulations, on the edges linear, at the corners 0 and 1: the limits of the formula. They are positive
/// inside, sum to one and reproduce the point, to rounding. Where the formula loses digits - within
/// tolerance::relative of the plane of a face, and outside of [-2, 2]^3 - they are those of the nearest point
/// of the plane or of that cube plus a linear term; so far away they extrapolate affinely.
Eigen::Matrix<double, 8, 1> cube_coordinates(const Eigen::Vector3d& point);

/// `cube_coordinates` of n points in the frame where the box `rest` is that cube.
///
/// Mean value coordinates are not invariant under affine maps: normalising the box first is a choice. It
/// makes them as well conditioned for a plank as for a cube, and keeps linear precision. Along an axis in
/// which the box has no extent points count as lying on it. Precondition: `rest` is a box or a
/// parallelepiped.
CornerWeights mean_value_coordinates(const Cuboid& rest, const Points& points);

}  // namespace stackabilization
