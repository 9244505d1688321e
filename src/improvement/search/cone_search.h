#pragma once

#include <Eigen/Core>
#include <optional>

#include "stackabilization/improvement/requirements.h"

namespace stackabilization::detail {

/// Restriction of a direction by the symmetries of a structure.
struct DirectionFreedom {
  bool fixed = false;  ///< two symmetry planes or an axis of symmetry contain the direction
  /// Normal of the only symmetry plane that contains the direction: unit, orthogonal to the direction.
  std::optional<Eigen::Vector3d> plane_normal;
};

/// Returns how the symmetries of `structure` restrict `direction`.
DirectionFreedom freedom_of(const Structure& structure, const Direction& direction);

/// Local search for a better stacking direction of a candidate (paper, end of section 4.3).
class ConeSearch {
 public:
  ConeSearch(const RequirementChecker& checker, double cone_degrees)
      : checker_(checker), cone_degrees_(cone_degrees) {}

  /// Returns the measures along a direction of larger S, within the cone and within the symmetry plane that
  /// contains the old direction. S is larger by more than tolerance::stackability. Where the requirements
  /// keep the height, the design has the height of the shape at rest along the new direction. Nothing if
  /// there is no such direction. Samples the cone, then climbs from the best sample. Deterministic for any
  /// number of threads.
  std::optional<Stackability> better(const Shape& shape, const Stackability& now) const;

 private:
  bool keeps_height(const Shape& shape, const Eigen::Vector3d& direction) const;
  std::optional<Stackability> best_of(const std::vector<std::optional<Stackability>>& samples) const;

  const RequirementChecker& checker_;
  double cone_degrees_;
};

}  // namespace stackabilization::detail
