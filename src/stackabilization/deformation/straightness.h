#pragma once

#include <Eigen/Core>

#include "stackabilization/structure/primitive.h"

namespace stackabilization::detail {

/// Whether the curve of an open generalized cylinder stays near to its chord.
bool is_straight(const GeneralizedCylinder& cylinder);

/// What becomes of the radii of sections that slide along their line.
enum class SlidingRadii { kept, of_place };

/// The combinations of `basis` (columns of changes of control values, see ControlState) that leave the
/// sections of a straight cylinder on one line, to first order: they may slide along it and the line may move
/// and lean, but not bend. A leg whose rail goes up is not to be drawn into a knee. Sections that slide take
/// the radii of the places they come to, so that the profile stays: a cone whose handle goes up stays a cone.
///
/// With SlidingRadii::kept they keep their own, for cylinders whose radii an edit prescribes.
Eigen::MatrixXd straight_columns(const GeneralizedCylinder& now, const Eigen::MatrixXd& basis,
                                 SlidingRadii radii);

}  // namespace stackabilization::detail
