#pragma once

#include <Eigen/Core>
#include <optional>

#include "stackabilization/structure/primitive.h"

namespace stackabilization::detail {

/// Whether the curve of an open generalized cylinder stays near to its chord.
bool is_straight(const GeneralizedCylinder& cylinder);

/// Whether, besides, its radii stay near to those of a cylinder or cone through its first and last section.
bool has_straight_wall(const GeneralizedCylinder& cylinder);

/// n places of the sections along the chord, model units, 0 at the first section.
Eigen::VectorXd places_along_chord(const GeneralizedCylinder& cylinder);

/// n x m: what sections of an open cylinder may slide by, as functions of the section, of size 1 in the
/// middle. Their products sum to the covariance of a Brownian bridge over the arc length at rest [Wahba]: the
/// ends stay, and of all slides that take some sections to given places the one of least norm is linear
/// between them, so that nothing crowds. Near the ends, where rims, floors and roundings are, hardly anything
/// is stretched.
Eigen::MatrixXd slide_functions(const GeneralizedCylinder& rest);

/// What an edit prescribes for a straight cylinder.
struct StraightHandle {
  std::optional<int> section;  ///< whose centre corrections do not push aside
  std::optional<int> radius;   ///< of this section, kept
};

/// Corrections of a straight generalized cylinder that leave it straight: it moves, leans and stretches, its
/// sections slide along it, and its radii change linearly along it. Sections that slide take the radii of the
/// places that they come to, so that the profile, as a function of the place between both ends, stays but for
/// that linear change: a cone whose handle goes up stays a cone. What `start` is off its chord it stays.
class StraightCorrections {
 public:
  /// `slides` as of slide_functions, `strain` as of strain_length; `start` is straight.
  StraightCorrections(GeneralizedCylinder start, const Eigen::MatrixXd& slides, double strain,
                      StraightHandle handle);

  /// 4n x k: these corrections around `now`, to first order, as columns of changes of control values (see
  /// ControlState).
  Eigen::MatrixXd columns(const GeneralizedCylinder& now) const;
  /// `now` with what steps along the columns did to higher order taken back.
  GeneralizedCylinder settled(GeneralizedCylinder now) const;

 private:
  /// Piece of the profile that a place between both ends lies on, the lower one at a section.
  Eigen::Index piece_at(double place) const;
  double slope(Eigen::Index piece) const;
  double radius_at(double place) const;
  double slope_at(double place) const;

  GeneralizedCylinder start_;
  const Eigen::MatrixXd& slides_;
  double strain_;
  StraightHandle handle_;
  int from_, to_;            ///< sections whose centres stay when the others are put on the line through them
  Points offsets_;           ///< of the sections of `start_` from that line
  Eigen::VectorXd profile_;  ///< places of the sections of `start_` between both ends, 0 to 1
};

}  // namespace stackabilization::detail
