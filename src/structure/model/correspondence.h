#pragma once

#include <vector>

#include "stackabilization/structure/primitive.h"

namespace stackabilization {

/// Returns, for each control point of `a`, the control point of `b` that corresponds to its image under
/// `map`. The result minimises the sum of squared distances over all assignments that preserve the
/// combinatorics: the 48 relabellings of a box, the reversal of an open curve, the shifts and reversals of a
/// closed curve. Empty when the kinds or the numbers of control points differ.
std::vector<int> control_correspondence(const Primitive& a, const Primitive& b, const Eigen::Isometry3d& map);

/// Returns the inverse of a permutation.
std::vector<int> inverse_order(const std::vector<int>& order);

/// Returns the composition of two permutations: first `first`, then `second`.
std::vector<int> composed_order(const std::vector<int>& first, const std::vector<int>& second);

}  // namespace stackabilization
