#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace stackabilization {

/// Cone of the directions within `half_angle` of `axis`.
struct DirectionCone {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< non-zero, any length
  double half_angle = 0;                            ///< radians, in (0, pi/2]
};

/// Set of directions that a search considers: the whole sphere, a cone, a plane through the origin, or the
/// intersection of a cone and a plane. r and -r count as one direction. Their representative is the one in
/// the cone, otherwise the one whose last non-zero component is positive.
class DirectionRegion {
 public:
  /// Throws UsageError for a zero or non-finite axis or normal, and for a half angle out of range.
  DirectionRegion(const std::optional<DirectionCone>& cone,
                  const std::optional<Eigen::Vector3d>& plane_normal);

  /// Returns the representative of `vector`, with its length, when it lies in the region (to
  /// tolerance::relative in angle), and nothing otherwise.
  std::optional<Eigen::Vector3d> member(const Eigen::Vector3d& vector) const;
  /// Returns the unit direction of the region nearest to `vector`. Returns nothing when rounding leaves no
  /// meaningful direction. With a cone and a plane, it returns nothing when the projection of `vector` onto
  /// the plane is outside the cone.
  std::optional<Eigen::Vector3d> nearest(const Eigen::Vector3d& vector) const;
  /// Returns evenly distributed directions of the region. Their distance is about `spacing` radians, and at
  /// most a sixth of the width of the region.
  std::vector<Eigen::Vector3d> samples(double spacing) const;

 private:
  Eigen::Vector3d with_sign(const Eigen::Vector3d& vector) const;

  std::optional<DirectionCone> cone_;
  std::optional<Eigen::Vector3d> plane_normal_;
};

/// Returns directions on the half circle orthogonal to `normal`, `spacing` radians apart.
std::vector<Eigen::Vector3d> half_circle(const Eigen::Vector3d& normal, double spacing);

}  // namespace stackabilization
