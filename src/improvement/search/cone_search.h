#pragma once

#include <Eigen/Core>
#include <optional>

#include "stackabilization/improvement/requirements.h"

namespace stackabilization::detail {

/// How symmetry planes of a structure restrict a direction that lies in them.
struct DirectionFreedom {
  bool fixed = false;                           ///< several planes, or an axis of rotation along it
  std::optional<Eigen::Vector3d> plane_normal;  ///< of the one plane: unit, orthogonal to the direction
};

DirectionFreedom freedom_of(const Structure& structure, const Direction& direction);

/// Looks for a better direction near that of a candidate (paper, end of section 4.3).
class ConeSearch {
 public:
  ConeSearch(const RequirementChecker& checker, double cone_degrees)
      : checker_(checker), cone_degrees_(cone_degrees) {}

  /// The measures along a direction within the cone and the symmetry planes that contain the old one, whose S
  /// is larger by more than tolerance::stackability, and along which the height is what it was where the
  /// requirements keep it; nothing where none is found. Samples, then a climb from the best of them.
  /// Deterministic for any number of threads.
  std::optional<Stackability> better(const Shape& shape, const Stackability& now) const;

 private:
  bool keeps_height(const Shape& shape, const Eigen::Vector3d& direction) const;
  std::optional<Stackability> best_of(const std::vector<std::optional<Stackability>>& samples) const;

  const RequirementChecker& checker_;
  double cone_degrees_;
};

}  // namespace stackabilization::detail
