#include "stackabilization/deformation/straightness.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>

#include "stackabilization/shape/tolerances.h"

namespace stackabilization::detail {

namespace {

/// Largest distance from the chord of what is called straight, fraction of the chord.
constexpr double straight_enough = 0.02;

Eigen::Vector3d chord_of(const GeneralizedCylinder& cylinder) {
  return (cylinder.centres.row(cylinder.centres.rows() - 1) - cylinder.centres.row(0)).transpose();
}

/// dr / ds of the profile at each section, by central differences.
Eigen::VectorXd profile_slopes(const GeneralizedCylinder& cylinder, const Eigen::VectorXd& places) {
  const Eigen::Index last = places.size() - 1;
  Eigen::VectorXd slopes = Eigen::VectorXd::Zero(last + 1);
  for (Eigen::Index i = 0; i <= last; ++i) {
    const Eigen::Index before = std::max<Eigen::Index>(i - 1, 0), after = std::min(i + 1, last);
    const double length = places(after) - places(before);
    if (length > 0) slopes(i) = (cylinder.radii(after) - cylinder.radii(before)) / length;
  }
  return slopes;
}

}  // namespace

bool is_straight(const GeneralizedCylinder& cylinder) {
  if (cylinder.closed) return false;
  const Eigen::Vector3d chord = chord_of(cylinder);
  for (Eigen::Index i = 1; i + 1 < cylinder.centres.rows(); ++i) {
    const Eigen::Vector3d offset = (cylinder.centres.row(i) - cylinder.centres.row(0)).transpose();
    if (!(offset.cross(chord).norm() <= straight_enough * chord.squaredNorm())) return false;
  }
  return true;
}

Eigen::MatrixXd straight_columns(const GeneralizedCylinder& now, const Eigen::MatrixXd& basis,
                                 SlidingRadii radii) {
  const Eigen::Index n = now.centres.rows();
  const Eigen::Vector3d along = chord_of(now).normalized();
  Eigen::MatrixXd line(n, 2);
  line << Eigen::VectorXd::Ones(n), (now.centres.rowwise() - now.centres.row(0)) * along;
  const Eigen::MatrixXd off_line =
      Eigen::MatrixXd::Identity(n, n) - line * (line.transpose() * line).inverse() * line.transpose();
  Eigen::MatrixXd bends = Eigen::MatrixXd::Zero(3 * n, basis.cols());
  for (Eigen::Index column = 0; column < basis.cols(); ++column) {
    const Eigen::VectorXd values = basis.col(column).head(3 * n);
    const Eigen::Map<const Points> moves(values.data(), n, 3);
    const Points across = moves - (moves * along) * along.transpose();
    Eigen::Map<Points>(bends.col(column).data(), n, 3) = off_line * across;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(bends.transpose() * bends);
  const Eigen::VectorXd& strength = solver.eigenvalues();
  Eigen::Index free = 0;
  while (free < strength.size() && strength(free) <= tolerance::redundant * strength(strength.size() - 1))
    ++free;
  Eigen::MatrixXd columns = basis;
  if (strength.size() > 0 && strength(strength.size() - 1) > 0)
    columns = basis * solver.eigenvectors().leftCols(free);
  if (radii == SlidingRadii::kept) return columns;
  const Eigen::VectorXd slopes = profile_slopes(now, line.col(1));
  for (Eigen::Index column = 0; column < columns.cols(); ++column) {
    const Eigen::VectorXd values = columns.col(column).head(3 * n);
    const Eigen::VectorXd places = Eigen::Map<const Points>(values.data(), n, 3) * along;
    const Eigen::VectorXd slides = off_line * places;
    columns.col(column).tail(n) += slopes.cwiseProduct(slides);
  }
  return columns;
}

}  // namespace stackabilization::detail
