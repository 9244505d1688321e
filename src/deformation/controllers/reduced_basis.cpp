#include "deformation/controllers/reduced_basis.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <vector>

#include "deformation/model/straight_curve.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {

namespace {

/// Standard deviation of the Gaussian of an edit, fraction of the arc length.
constexpr double spread_sigma = 0.2;
/// Smooth functions along the curve with less than this fraction of the largest eigenvalue are omitted.
constexpr double weakest_mode = 0.001;
/// Parts below this fraction of the diagonal are small.
constexpr double small_part = 0.1;

/// Appends the Kronecker product with the identity of size 3: a function along the points becomes three
/// columns.
void append_moves(const Eigen::MatrixXd& functions, double factor, Eigen::MatrixXd& basis,
                  Eigen::Index& column) {
  for (Eigen::Index f = 0; f < functions.cols(); ++f)
    for (int k = 0; k < 3; ++k, ++column)
      for (Eigen::Index i = 0; i < functions.rows(); ++i) basis(3 * i + k, column) = factor * functions(i, f);
}

/// Computes n x m functions F along the curve: F F^T is the Gaussian matrix without its weak modes.
Eigen::MatrixXd smooth_functions(const GeneralizedCylinder& cylinder) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gaussian_spread(cylinder));
  const Eigen::VectorXd& strength = solver.eigenvalues();
  Eigen::Index first = 0;
  while (strength(first) < weakest_mode * strength(strength.size() - 1)) ++first;
  const Eigen::Index count = strength.size() - first;
  return solver.eigenvectors().rightCols(count) * strength.tail(count).cwiseSqrt().asDiagonal();
}

/// Computes n x (1 + rank) functions over the centres: 1, and F with F F^T = C C^T / s^2 for the centred
/// positions C, where the largest singular value of F is sqrt(n). So an affine map costs its strain.
/// Functions of mean square 1 would make a map cheap that moves centres by how little they deviate from a
/// plane, and crumples them.
Eigen::MatrixXd affine_functions(const GeneralizedCylinder& cylinder) {
  const Eigen::Index n = cylinder.centres.rows();
  const Eigen::MatrixXd centred = cylinder.centres.rowwise() - cylinder.centres.colwise().mean();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  qr.setThreshold(tolerance::relative);
  qr.compute(centred);
  const Eigen::Index rank = qr.rank();
  const Eigen::MatrixXd orthonormal = qr.householderQ() * Eigen::MatrixXd::Identity(n, rank);
  const Eigen::MatrixXd components = orthonormal.transpose() * centred;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(components * components.transpose());
  const Eigen::VectorXd extents = solver.eigenvalues().cwiseMax(0).cwiseSqrt();
  const Eigen::MatrixXd& axes = solver.eigenvectors();
  Eigen::MatrixXd functions(n, 1 + rank);
  functions << Eigen::VectorXd::Ones(n),
      std::sqrt(static_cast<double>(n)) * orthonormal *
          (axes * (extents / extents.maxCoeff()).asDiagonal() * axes.transpose());
  return functions;
}

Eigen::MatrixXd basis_of(const GeneralizedCylinder& cylinder, Following following) {
  const Eigen::Index n = cylinder.centres.rows();
  if (following == Following::smooth) {
    const Eigen::MatrixXd affine = affine_functions(cylinder);
    Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(4 * n, 3 * affine.cols() + 1);
    Eigen::Index column = 0;
    append_moves(affine, 1, basis, column);
    basis.bottomRightCorner(n, 1) = radius_scale * cylinder.radii / cylinder.radii.mean();
    return basis;
  }
  const Eigen::MatrixXd affine = affine_functions(cylinder), smooth = smooth_functions(cylinder);
  const Eigen::Index moves = 3 * (affine.cols() + smooth.cols());
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(4 * n, moves + smooth.cols());
  Eigen::Index column = 0;
  append_moves(affine, 1, basis, column);
  append_moves(smooth, bending_scale, basis, column);
  basis.bottomRightCorner(n, smooth.cols()) = radius_scale * smooth;
  return basis;
}

/// The functions of a cuboid are products of the signs of the three coordinates of a corner: 1, x, y, z are
/// affine; xy, yz, zx and xyz are not. Equal strains have equal costs: changing the thickness of a plate by
/// half costs as much as changing its length by half.
Eigen::MatrixXd basis_of(const Cuboid& cuboid, Following following) {
  Eigen::Vector3d sides;
  for (int axis = 0; axis < 3; ++axis)
    sides(axis) = (cuboid.corners.row(1 << axis) - cuboid.corners.row(0)).norm();
  sides /= sides.maxCoeff();
  Eigen::MatrixXd affine(8, 4), bent(8, 4);
  for (int k = 0; k < 8; ++k) {
    const double x = (k & 1) != 0 ? 1 : -1, y = (k & 2) != 0 ? 1 : -1, z = (k & 4) != 0 ? 1 : -1;
    affine.row(k) << 1, x * sides.x(), y * sides.y(), z * sides.z();
    bent.row(k) << x * y, y * z, z * x, x * y * z;
  }
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(24, 24);
  Eigen::Index column = 0;
  append_moves(affine, 1, basis, column);
  if (following == Following::smooth) return basis.leftCols(column);
  append_moves(bent, corner_scale, basis, column);
  return basis;
}

}  // namespace

double strain_scale(const Primitive& rest, double diagonal) {
  const Points points = control_points(rest);
  double size = (points.rowwise() - points.row(0)).rowwise().norm().maxCoeff();
  if (const auto* cylinder = std::get_if<GeneralizedCylinder>(&rest))
    size = std::max(size, 2 * cylinder->radii.maxCoeff());
  return std::min(1.0, size / (small_part * diagonal));
}

Eigen::MatrixXd gaussian_spread(const GeneralizedCylinder& rest) {
  const Eigen::VectorXd s = section_arc_lengths(rest);
  const double whole = s(s.size() - 1), sigma = spread_sigma * whole;
  const Eigen::Index n = rest.centres.rows();
  Eigen::MatrixXd spread(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      double distance = std::abs(s(i) - s(j));
      if (rest.closed) distance = std::min(distance, whole - distance);
      spread(i, j) = std::exp(-distance * distance / (2 * sigma * sigma));
    }
  return spread;
}

Eigen::VectorXd linear_weights(const GeneralizedCylinder& now, int section) {
  const Eigen::VectorXd s = is_straight(now) ? places_along_chord(now) : section_arc_lengths(now);
  const double whole = s(s.size() - 1), far = s(section) > whole - s(section) ? 0 : whole;
  return (s.array() - far) / (s(section) - far);
}

Eigen::MatrixXd edit_kernel(const Primitive& rest) {
  const auto* cylinder = std::get_if<GeneralizedCylinder>(&rest);
  if (cylinder == nullptr) return Eigen::MatrixXd::Identity(24, 24);
  const Eigen::Index n = cylinder->centres.rows();
  const Eigen::MatrixXd spread = gaussian_spread(*cylinder);
  Eigen::MatrixXd kernel = Eigen::MatrixXd::Zero(4 * n, 4 * n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      for (int k = 0; k < 3; ++k) kernel(3 * i + k, 3 * j + k) = spread(i, j);
      kernel(3 * n + i, 3 * n + j) = cylinder->radii(i) * spread(i, j) * cylinder->radii(j);
    }
  return kernel;
}

Eigen::MatrixXd reduced_basis(const Primitive& rest, double strain, Following following) {
  Eigen::MatrixXd basis =
      std::visit([&](const auto& primitive) { return basis_of(primitive, following); }, rest);
  basis.rightCols(basis.cols() - 3) *= strain;
  return basis;
}

Eigen::MatrixXd turning(const GeneralizedCylinder& rest) {
  const Points centred = rest.centres.rowwise() - rest.centres.colwise().mean();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  Eigen::MatrixXd moments(3, 3 * centred.rows());
  for (Eigen::Index i = 0; i < centred.rows(); ++i) {
    const Eigen::Vector3d r = centred.row(i).transpose();
    Eigen::Matrix3d cross;
    cross << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
    moments.middleCols<3>(3 * i) = cross;
    inertia -= cross * cross;
  }
  Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix3d> solver;
  solver.setThreshold(tolerance::relative);
  solver.compute(inertia);
  return solver.pseudoInverse() * moments;
}

}  // namespace stackabilization::detail
