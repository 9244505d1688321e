#pragma once

#include <Eigen/Core>
#include <vector>

// Least-squares affine maps of sets of points, such as the vertices of a wire.
namespace stackabilization::detail {

/// Least-squares affine map of points to their new positions. In directions that the points do not span, the
/// map rotates with the spanned directions and does not stretch.
class WireFit {
 public:
  /// `members`: rows of `points` that take part, at least one. `points`: positions at rest.
  WireFit(std::vector<int> members, const std::vector<Eigen::Vector3d>& points);

  /// Returns the centroid of the members at rest.
  const Eigen::Vector3d& centre() const { return centre_; }
  /// Returns the centroid of the members at the positions `points`.
  Eigen::Vector3d moved_centre(const std::vector<Eigen::Vector3d>& points) const;
  /// Returns the linear part of the map from the positions at rest to `points`.
  Eigen::Matrix3d linear(const std::vector<Eigen::Vector3d>& points) const;

 private:
  std::vector<int> members_;
  std::vector<Eigen::Vector3d>
      arms_;  ///< offsets of the members from their centre, times the inverse of their scatter matrix
  Eigen::Vector3d centre_;
  Eigen::Matrix3d directions_;  ///< principal directions as columns, the spanned ones first
  int rank_ = 0;
};

}  // namespace stackabilization::detail
