#pragma once

#include <vector>

#include "stackabilization/structure/primitive.h"

namespace stackabilization {

/// Which control point of `b` the image of each control point of `a` under `map` belongs to: the assignment,
/// among those that keep the combinatorics (the 48 relabellings of a box; reversal of an open curve; shifts
/// and reversals of a closed one), with the smallest sum of squared distances. Empty when the kinds or
/// numbers of control points differ.
std::vector<int> control_correspondence(const Primitive& a, const Primitive& b, const Eigen::Isometry3d& map);

}  // namespace stackabilization
