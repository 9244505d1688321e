#pragma once

#include <Eigen/Core>
#include <optional>

#include "stackabilization/structure/primitive.h"

namespace stackabilization::detail {

/// Computes the n x m basis F of the slides of the n sections of an open cylinder along it. F F^T is the
/// covariance of a Brownian bridge over the arc length at rest [Wahba], with value 1 in the middle. Hence the
/// ends stay. Of all slides that move some sections to given positions, the one of least norm is linear
/// between these sections, so that no sections crowd. Near the ends, where rims, floors and roundings are,
/// slides hardly stretch the cylinder.
Eigen::MatrixXd slide_functions(const GeneralizedCylinder& rest);

/// Section of a straight cylinder that an edit prescribes.
struct StraightHandle {
  std::optional<int> section;  ///< section whose centre corrections do not push aside
  std::optional<int> radius;   ///< section whose radius corrections keep
};

/// Corrections of a straight generalized cylinder that keep it straight. It moves, leans and stretches, its
/// sections slide along it, and its radii change linearly along it. Sliding sections take the radii of their
/// new positions. The profile, the radius as a function of the position between both ends, therefore changes
/// only by the linear function: a cone whose handle moves up stays a cone. Offsets of `start` from its chord
/// are preserved.
class StraightCorrections {
 public:
  /// `slides`: see slide_functions; it must outlive this object. `strain`: see strain_scale. Precondition:
  /// `start` is straight.
  StraightCorrections(GeneralizedCylinder start, const Eigen::MatrixXd& slides, double strain,
                      StraightHandle handle);

  /// Computes these corrections to first order around `now`: 4n x k columns of changes of control values (see
  /// ControlState).
  Eigen::MatrixXd columns(const GeneralizedCylinder& now) const;
  /// Removes the higher-order effects of steps along the columns from `now`.
  GeneralizedCylinder retract(GeneralizedCylinder now) const;

 private:
  /// Returns the piece of the profile at a position between both ends; at a section, the lower piece.
  Eigen::Index piece_at(double place) const;
  double slope(Eigen::Index piece) const;
  double radius_at(double place) const;
  double slope_at(double place) const;

  GeneralizedCylinder start_;
  const Eigen::MatrixXd& slides_;
  double strain_;
  StraightHandle handle_;
  /// Sections that define the line on which `retract` puts the centres of the others.
  int from_, to_;
  Points offsets_;           ///< offsets of the sections of `start_` from that line
  Eigen::VectorXd profile_;  ///< positions of the sections of `start_` between both ends, 0 to 1
};

}  // namespace stackabilization::detail
