#include "improvement/quality/affine_fit.h"

#include <Eigen/Eigenvalues>

#include "numerics/polar_decomposition.h"
#include "stackabilization/improvement/tolerances.h"

namespace stackabilization::detail {

AffineFit::AffineFit(const Points& rest) : from_(rest.colwise().mean().transpose()) {
  centred_ = rest.rowwise() - from_.transpose();
  const Eigen::Matrix3d moments = centred_.transpose() * centred_;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments);
  for (int k = 0; k < 3; ++k) axes_.col(k) = solver.eigenvectors().col(2 - k);
  if (axes_.determinant() < 0) axes_.col(2) *= -1;
  for (int k = 0; k < 3; ++k) squares_(k) = solver.eigenvalues()(2 - k);
  const double least = tolerance::quality::flat * tolerance::quality::flat * squares_(0);
  while (rank_ < 3 && squares_(rank_) > least) ++rank_;
}

AffineMap AffineFit::map(const Points& now) const {
  AffineMap result;
  result.from = from_;
  result.to = now.colwise().mean().transpose();
  if (rank_ == 0) return result;
  const Points moved = now.rowwise() - result.to.transpose();
  Eigen::Matrix3d images = Eigen::Matrix3d::Zero();  // of the axes, in columns
  for (int k = 0; k < rank_; ++k) images.col(k) = moved.transpose() * (centred_ * axes_.col(k)) / squares_(k);
  if (rank_ < 3) {
    // The remaining axes follow the rotation nearest to the map of the others.
    const Eigen::Matrix3d rotation = polar_decomposition(images * axes_.transpose()).rotation;
    for (int k = rank_; k < 3; ++k) images.col(k) = rotation * axes_.col(k);
  }
  result.linear = images * axes_.transpose();
  return result;
}

}  // namespace stackabilization::detail
