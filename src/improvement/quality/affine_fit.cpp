#include "improvement/quality/affine_fit.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "numerics/polar_decomposition.h"
#include "stackabilization/improvement/tolerances.h"

namespace stackabilization::detail {

namespace {

/// Ratio of the extents along the last two axes up to which points are those of a plate.
constexpr double thin_ratio = 0.25;
/// Share of the extent across a plate that must be left without what is quadratic along it; a curved sheet
/// has none.
constexpr double min_thin = 0.1;

/// Returns the third coordinates less their best quadratic function of the first two, in any unit.
/// Precondition: `places`, n x 3, are not all 0 in these.
Eigen::VectorXd without_quadratic(const Points& places) {
  const double unit = places.leftCols<2>().cwiseAbs().maxCoeff();
  const Eigen::ArrayXd x = places.col(0).array() / unit, y = places.col(1).array() / unit;
  Eigen::Matrix<double, Eigen::Dynamic, 6> functions(places.rows(), 6);
  functions << Eigen::VectorXd::Ones(places.rows()), x.matrix(), y.matrix(), (x * x).matrix(),
      (x * y).matrix(), (y * y).matrix();
  return places.col(2) - functions * functions.colPivHouseholderQr().solve(places.col(2));
}

}  // namespace

AffineFit::AffineFit(const Points& rest) : from_(rest.colwise().mean().transpose()) {
  centred_ = rest.rowwise() - from_.transpose();
  const Eigen::Matrix3d moments = centred_.transpose() * centred_;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments);
  for (int k = 0; k < 3; ++k) axes_.col(k) = solver.eigenvectors().col(2 - k);
  if (axes_.determinant() < 0) axes_.col(2) *= -1;
  for (int k = 0; k < 3; ++k) squares_(k) = solver.eigenvalues()(2 - k);
  const double least = tolerance::quality::flat * tolerance::quality::flat * squares_(0);
  while (rank_ < 3 && squares_(rank_) > least) ++rank_;
  if (rank_ < 3 || squares_(2) > thin_ratio * thin_ratio * squares_(1)) return;
  thin_ = without_quadratic(centred_ * axes_);
  if (thin_.squaredNorm() < min_thin * min_thin * squares_(2)) thin_.resize(0);
}

AffineMap AffineFit::map(const Points& now) const {
  AffineMap result;
  result.from = from_;
  result.to = now.colwise().mean().transpose();
  if (rank_ == 0) return result;
  const Points moved = now.rowwise() - result.to.transpose();
  Eigen::Matrix3d images = Eigen::Matrix3d::Zero();  // of the axes, in columns
  for (int k = 0; k < rank_; ++k) images.col(k) = moved.transpose() * (centred_ * axes_.col(k)) / squares_(k);
  if (thin_.size() > 0) images.col(2) = moved.transpose() * thin_ / thin_.dot(centred_ * axes_.col(2));
  if (rank_ < 3) {
    // The remaining axes follow the rotation nearest to the map of the others.
    const Eigen::Matrix3d rotation = polar_decomposition(images * axes_.transpose()).rotation;
    for (int k = rank_; k < 3; ++k) images.col(k) = rotation * axes_.col(k);
  }
  result.linear = images * axes_.transpose();
  return result;
}

Eigen::Matrix3d AffineFit::without_slide(const AffineMap& map) const {
  if (thin_.size() == 0) return map.linear;
  Eigen::Matrix3d images = map.linear * axes_;
  const Eigen::Vector3d normal = images.col(0).cross(images.col(1)).normalized();
  images.col(2) = normal.dot(images.col(2)) * normal;
  return images * axes_.transpose();
}

}  // namespace stackabilization::detail
