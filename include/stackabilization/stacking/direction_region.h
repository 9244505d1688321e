#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace stackabilization {

/// Directions within `half_angle` of `axis`.
struct DirectionCone {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< any length but 0
  double half_angle = 0;                            ///< radians, in (0, pi/2]
};

/// Where a search may look: the whole sphere, a cone, a plane through the origin, or what a cone and a plane
/// share. r and -r count as one direction; the one in the cone, else the one whose last component other than
/// 0 is positive, stands for both.
class DirectionRegion {
 public:
  /// Throws UsageError when the cone's axis or half angle or the plane's normal is not usable.
  DirectionRegion(const std::optional<DirectionCone>& cone,
                  const std::optional<Eigen::Vector3d>& plane_normal);

  /// `vector`, length kept and signed as above, when it lies in the region (to tolerance::relative in angle).
  std::optional<Eigen::Vector3d> member(const Eigen::Vector3d& vector) const;
  /// The unit direction of the region nearest to `vector`; nothing when rounding leaves no meaningful one or,
  /// with cone and plane, when its projection onto the plane is outside the cone.
  std::optional<Eigen::Vector3d> nearest(const Eigen::Vector3d& vector) const;
  /// Evenly spread directions of the region about `spacing` radians apart, and at most a sixth of its width.
  std::vector<Eigen::Vector3d> samples(double spacing) const;

 private:
  Eigen::Vector3d with_sign(const Eigen::Vector3d& vector) const;

  std::optional<DirectionCone> cone_;
  std::optional<Eigen::Vector3d> plane_normal_;
};

/// Directions on the half circle orthogonal to `normal`, `spacing` radians apart.
std::vector<Eigen::Vector3d> half_circle(const Eigen::Vector3d& normal, double spacing);

}  // namespace stackabilization
