#pragma once

#include <Eigen/Core>
#include <array>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// A map of level sections to level sections: a linear map across, which changes in proportion to the height,
/// a level shift, and a stretch along the upright axis.
struct TaperMap {
  Eigen::Matrix<double, 2, 3> axes;     ///< level axes, orthonormal, in rows
  Eigen::Vector3d up, from;             ///< unit; the point of the lower end that is only shifted and raised
  double height = 1;                    ///< at rest, model units
  std::array<Eigen::Matrix2d, 2> ends;  ///< linear maps at the lower and at the upper end
  Eigen::Vector2d shift;                ///< along `axes`, model units
  double stretch = 1, rise = 0;         ///< along `up`; the rise of the lower end, model units

  Eigen::Vector3d operator()(const Eigen::Vector3d& p) const;
};

/// Fits the taper that maps points at rest to where they are now, one per row, in the least-squares sense.
/// `up`: unit. `along`: heights of both ends at rest along `up`, model units. Precondition: they differ.
TaperMap fit_taper(const Points& rest, const Points& now, const Eigen::Vector3d& up, const Range& along);

}  // namespace stackabilization::detail
