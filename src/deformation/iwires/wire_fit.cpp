#include "deformation/iwires/wire_fit.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <utility>

namespace stackabilization::detail {

namespace {

/// Points span a direction when they spread along it by more than this fraction of their largest spread. In
/// thinner directions a fit would magnify residuals.
constexpr double thin = 0.05;

}  // namespace

WireFit::WireFit(std::vector<int> members, const std::vector<Eigen::Vector3d>& points)
    : members_(std::move(members)), centre_(moved_centre(points)) {
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const int k : members_) {
    arms_.push_back(points[static_cast<std::size_t>(k)] - centre_);
    scatter += arms_.back() * arms_.back().transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(scatter);
  directions_ = axes.eigenvectors().rowwise().reverse();
  const Eigen::Vector3d spread = axes.eigenvalues().reverse();
  while (rank_ < 3 && spread(rank_) > thin * thin * spread(0)) ++rank_;
  Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();
  for (int c = 0; c < rank_; ++c) inverse += directions_.col(c) * directions_.col(c).transpose() / spread(c);
  for (Eigen::Vector3d& arm : arms_) arm = inverse * arm;
}

Eigen::Vector3d WireFit::moved_centre(const std::vector<Eigen::Vector3d>& points) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int k : members_) sum += points[static_cast<std::size_t>(k)];
  return sum / static_cast<double>(members_.size());
}

Eigen::Matrix3d WireFit::linear(const std::vector<Eigen::Vector3d>& points) const {
  if (rank_ == 0) return Eigen::Matrix3d::Identity();
  Eigen::Matrix3d map = Eigen::Matrix3d::Zero();
  const Eigen::Vector3d centre = moved_centre(points);
  for (std::size_t i = 0; i < members_.size(); ++i)
    map += (points[static_cast<std::size_t>(members_[i])] - centre) * arms_[i].transpose();
  if (rank_ == 2) {
    const Eigen::Vector3d normal = directions_.col(0).cross(directions_.col(1));
    const Eigen::Vector3d image = (map * directions_.col(0)).cross(map * directions_.col(1));
    map += (image.isZero(0) ? normal : image.normalized()) * normal.transpose();
  } else if (rank_ == 1) {
    const Eigen::Vector3d along = directions_.col(0), image = map * along;
    const Eigen::Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(along, image).toRotationMatrix();
    map += turn * (Eigen::Matrix3d::Identity() - along * along.transpose());
  }
  return map;
}

}  // namespace stackabilization::detail
