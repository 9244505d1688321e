#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/contacts.h"

namespace stackabilization::detail {

/// A copy of a shape that rests on the one below.
struct CopyJoint {
  double lift = 0;                     ///< f_max, model units
  std::vector<ContactRegion> regions;  ///< where the two touch
};

/// Stacks a shape on itself along r. `band`: as ContactOptions::band. Throws InputError when copies pass each
/// other along r.
CopyJoint copy_joint(const Shape& shape, const Direction& direction, ContactSemantics semantics, double band);

/// Throws UsageError unless `band` is between 0 and 1, `friction` finite and at least 0, and `up` within 90
/// degrees of r.
void check_statics(double band, const std::optional<double>& friction,
                   const std::optional<Eigen::Vector3d>& up, const Direction& direction);

}  // namespace stackabilization::detail
