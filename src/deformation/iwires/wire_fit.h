#pragma once

#include <Eigen/Core>
#include <vector>

/// Not installed.
namespace stackabilization::detail {

/// The affine map that fits best what happens to some points. Along directions which the points do not span,
/// it turns with the others and does not stretch.
class AffineFit {
 public:
  /// `members`: which of `points` take part; one at least.
  AffineFit(std::vector<int> members, const std::vector<Eigen::Vector3d>& points);

  const Eigen::Vector3d& centre() const { return centre_; }
  /// Where the centre goes when the points go to `points`.
  Eigen::Vector3d moved_centre(const std::vector<Eigen::Vector3d>& points) const;
  Eigen::Matrix3d linear(const std::vector<Eigen::Vector3d>& points) const;

 private:
  std::vector<int> members_;
  std::vector<Eigen::Vector3d>
      arms_;  ///< of the members from their centre, times the inverse of their scatter
  Eigen::Vector3d centre_;
  Eigen::Matrix3d directions_;  ///< columns, the spanned ones first
  int rank_ = 0;
};

}  // namespace stackabilization::detail
