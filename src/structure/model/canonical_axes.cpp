#include "structure/model/canonical_axes.h"

#include <cmath>

#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {

Eigen::Vector3d canonical_sense(const Eigen::Vector3d& direction) {
  for (const Eigen::Index k : {2, 1, 0})
    if (std::abs(direction(k)) > tolerance::relative * direction.norm())
      return direction(k) > 0 ? direction : Eigen::Vector3d(-direction);
  return direction;
}

Eigen::Vector3d orthogonal_axis(const Eigen::Vector3d& axis) {
  Eigen::Index upright = 0;
  for (Eigen::Index k = 1; k < 3; ++k)
    if (std::abs(axis(k)) < std::abs(axis(upright)) - tolerance::relative) upright = k;
  return (Eigen::Vector3d::Unit(upright) - axis(upright) * axis).normalized();
}

}  // namespace stackabilization::detail
