#include "structure/fitting/revolution_axis.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/surface_moments.h"
#include "stackabilization/core/tolerances.h"
#include "structure/fitting/part_box.h"

namespace stackabilization::detail {

namespace {

/// Largest root mean square deviation of a rotated part from itself for a round part, fraction of its largest
/// radius. A regular octagon has 0.035, a hexagon 0.06, a square 0.12.
constexpr double roundness = 0.04;

/// Residual of an axis direction, relative to the squared extent, below which every direction is an axis: a
/// sphere.
constexpr double any_axis = 0.001;

/// Quadratic form of the Pluecker coordinates (direction, moment) of a line: the integral over the surface of
/// the squared deviation of the normals from the line.
struct NormalComplex {
  Eigen::Matrix3d directions = Eigen::Matrix3d::Zero(), mixed = directions, moments = directions;
};

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

/// With n the normal at p, the lines (n, p x n) and (l, m) meet when n . m + (p x n) . l = 0. Coordinates are
/// relative to `origin` and `scale`.
NormalComplex normal_complex(const Shape& part, const Eigen::VectorXd& weights, const Eigen::Vector3d& origin,
                             double scale) {
  NormalComplex sum;
  for (Eigen::Index t = 0; t < part.triangle_count(); ++t) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = (part.corner(t, k) - origin) / scale;
    const Eigen::Vector3d double_area =
        (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0));
    const double triangle_area = double_area.norm() / 2, area = weights(t) * triangle_area;
    if (!(area > 0)) continue;
    const Eigen::Vector3d n = double_area / (2 * triangle_area), total = corners.rowwise().sum();
    const Eigen::Matrix3d turn = cross_matrix(n);  // n x p, the sign cancels below
    const Eigen::Matrix3d second = (corners * corners.transpose() + total * total.transpose()) / 12;
    sum.directions += area * turn * second * turn.transpose();
    sum.mixed -= area * turn * (total / 3) * n.transpose();
    sum.moments += area * n * n.transpose();
  }
  return sum;
}

/// Pseudo-inverse of a symmetric positive semidefinite matrix.
Eigen::Matrix3d pseudo_inverse(const Eigen::Matrix3d& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
  Eigen::Vector3d inverse = solver.eigenvalues();
  for (double& value : inverse) value = value > tolerance::relative * matrix.trace() ? 1 / value : 0;
  return solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose();
}

/// The direction of least residual; of several, the one nearest to a file axis, z before y before x.
Eigen::Vector3d direction_of_least_residual(const Eigen::Matrix3d& residual, double area) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(residual);
  if (solver.eigenvalues()(1) > any_axis * area) return solver.eigenvectors().col(0);
  const Eigen::Index dimension = solver.eigenvalues()(2) > any_axis * area ? 2 : 3;
  const auto basis = solver.eigenvectors().leftCols(dimension);
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  for (const int k : {2, 1, 0}) {
    const Eigen::Vector3d projected = basis * basis.row(k).transpose();
    if (projected.norm() > best.norm() + tolerance::relative) best = projected;
  }
  return best.normalized();
}

/// Root mean square distance from the part to itself turned about the axis.
double miss_when_turned(const FitSurface& part, const AxisLine& axis) {
  const Eigen::Index stride = 4;
  double sum = 0, count = 0;
  for (int turn = 1; turn <= 3; ++turn) {
    const Eigen::AngleAxisd rotation(turn * 2 * std::numbers::pi * (std::numbers::phi - 1), axis.direction);
    for (Eigen::Index k = turn; k < part.samples.points.rows(); k += stride) {
      const Eigen::Vector3d from = part.samples.points.row(k).transpose() - axis.point;
      const double distance = part.index.nearest(axis.point + rotation * from).distance;
      sum += distance * distance;
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

}  // namespace

std::optional<AxisLine> axis_of_normals(const Shape& part, const Eigen::VectorXd& weights) {
  const SurfaceMoments moments(part, part.corner(0, 0));
  const double scale = std::sqrt(moments.covariance().trace());
  const NormalComplex complex = normal_complex(part, weights, moments.centre(), scale);
  const Eigen::Matrix3d elimination = -pseudo_inverse(complex.moments) * complex.mixed.transpose();
  const Eigen::Matrix3d residual = complex.directions + complex.mixed * elimination;

  AxisLine axis;
  axis.direction =
      direction_of_least_residual((residual + residual.transpose()) / 2, complex.moments.trace());
  axis.point = moments.centre() + scale * axis.direction.cross(elimination * axis.direction);
  if (!axis.point.allFinite() || !axis.direction.allFinite()) return std::nullopt;
  return axis;
}

std::optional<AxisLine> revolution_axis(const FitSurface& part) {
  const auto axis = axis_of_normals(part.shape, Eigen::VectorXd::Ones(part.shape.triangle_count()));
  if (!axis) return std::nullopt;
  double radius = 0;
  for (const auto& point : part.samples.points.rowwise())
    radius = std::max(radius, (point.transpose() - axis->point).cross(axis->direction).norm());
  if (!(miss_when_turned(part, *axis) <= roundness * radius)) return std::nullopt;
  return axis;
}

}  // namespace stackabilization::detail
