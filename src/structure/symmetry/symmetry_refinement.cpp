#include "structure/symmetry/symmetry_refinement.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {

namespace {

constexpr int freedoms = 4;  // two turns and at most two shifts of the plane or axis
constexpr double min_information_share = 0.5;
constexpr double shrink = 0.25;
constexpr double settled = 0.001;  // step, fraction of the scale
constexpr int steps_per_scale = 6;

using Information = Eigen::Matrix<double, freedoms, freedoms>;

/// An infinitesimal motion of a plane or axis: turn about its foot point, then shift.
struct Freedom {
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
};

std::array<Freedom, freedoms> freedoms_of(const Symmetry& symmetry) {
  const Eigen::Vector3d u = symmetry.axis.unitOrthogonal(), v = symmetry.axis.cross(u);
  std::array<Freedom, freedoms> result;
  result[0].turn = u;
  result[1].turn = v;
  if (symmetry.kind == SymmetryKind::reflection) {
    result[2].shift = symmetry.axis;
  } else {
    result[2].shift = u;
    result[3].shift = v;
  }
  return result;
}

/// Distances of the images of all points, and their derivatives by the degrees of freedom.
struct Linearization {
  Eigen::VectorXd distances;
  Eigen::Matrix<double, Eigen::Dynamic, freedoms, Eigen::RowMajor> slopes;

  Eigen::VectorXd weights(double scale) const {
    const double square = scale * scale;
    return (square / (square + distances.array().square())).square();
  }
  Information information(double scale) const {
    return slopes.transpose() * weights(scale).asDiagonal() * slopes;
  }
};

Linearization linearized(const SymmetrySurface& surface, const Symmetry& symmetry, const Points& points) {
  const Eigen::Isometry3d map = isometry_of(symmetry);
  const std::array<Freedom, freedoms> motions = freedoms_of(symmetry);
  Linearization result{Eigen::VectorXd(points.rows()), {}};
  result.slopes.resize(points.rows(), freedoms);
  tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, points.rows(), 64), [&](const auto& range) {
    for (Eigen::Index k = range.begin(); k < range.end(); ++k) {
      const Eigen::Vector3d image = map * points.row(k).transpose();
      const SurfacePoint nearest = surface.index.nearest(image);
      // On the surface the distance has no gradient; a step along the normal leaves the surface.
      const Eigen::Vector3d gradient =
          nearest.distance > tolerance::relative
              ? Eigen::Vector3d((image - nearest.point) / nearest.distance)
              : Eigen::Vector3d(surface.normals.row(nearest.triangle).transpose());
      const Eigen::Vector3d arm = points.row(k).transpose() - symmetry.point, turned_arm = map.linear() * arm;
      result.distances(k) = nearest.distance;
      for (int f = 0; f < freedoms; ++f) {
        const auto& [turn, shift] = motions[static_cast<std::size_t>(f)];
        result.slopes(k, f) = gradient.dot(turn.cross(turned_arm) - map.linear() * turn.cross(arm) + shift -
                                           map.linear() * shift);
      }
    }
  });
  return result;
}

/// Returns the smallest share of the information about any degree of freedom that `part` preserves of
/// `whole`.
double share(const Information& part, const Information& whole) {
  const Information floor = Information::Identity() * (tolerance::relative * (whole.trace() + 1));
  return Eigen::GeneralizedSelfAdjointEigenSolver<Information>(part + floor, whole + floor,
                                                               Eigen::EigenvaluesOnly)
      .eigenvalues()
      .minCoeff();
}

/// Computes the motion that reduces the weighted distances most. Undetermined degrees of freedom stay.
Eigen::Matrix<double, freedoms, 1> best_step(const Linearization& at, double scale) {
  Information information = at.information(scale);
  information.diagonal().array() += tolerance::relative * (information.trace() + 1);
  return -information.ldlt().solve(at.slopes.transpose() * at.weights(scale).cwiseProduct(at.distances));
}

Symmetry moved(const Symmetry& symmetry, const Eigen::Matrix<double, freedoms, 1>& step) {
  Eigen::Vector3d turn = Eigen::Vector3d::Zero(), shift = Eigen::Vector3d::Zero();
  const std::array<Freedom, freedoms> motions = freedoms_of(symmetry);
  for (int f = 0; f < freedoms; ++f) {
    turn += step(f) * motions[static_cast<std::size_t>(f)].turn;
    shift += step(f) * motions[static_cast<std::size_t>(f)].shift;
  }
  Symmetry result = symmetry;
  result.axis = (symmetry.axis + turn.cross(symmetry.axis)).normalized();
  result.point += shift;
  result.point = foot(result);
  return result;
}

Points measured_points(const SymmetrySurface& surface, Effort effort) {
  if (effort == Effort::sparse) return surface.sparse.points;
  Points points(surface.medium.points.rows() + surface.corners.rows(), 3);
  points << surface.medium.points, surface.corners;
  return points;
}

/// A symmetry under refinement.
struct RobustFit {
  const SymmetrySurface& surface;
  Points points;
  Symmetry symmetry;
  Linearization at;

  RobustFit(const SymmetrySurface& of, const Symmetry& start, Effort effort)
      : surface(of),
        points(measured_points(of, effort)),
        symmetry(start),
        at(linearized(of, start, points)) {}

  /// Steps at one scale until the steps are small. Returns false when a step is larger than `reach`: nothing
  /// determines the plane there.
  bool settle(double scale, double reach) {
    for (int step = 0; step < steps_per_scale; ++step) {
      const Eigen::Matrix<double, freedoms, 1> motion = best_step(at, scale);
      if (motion.norm() > reach) return false;
      symmetry = moved(symmetry, motion);
      at = linearized(surface, symmetry, points);
      if (motion.norm() < settled * scale) break;
    }
    return true;
  }
};

}  // namespace

Symmetry step_symmetry(const SymmetrySurface& surface, const Symmetry& start, double reach, Effort effort) {
  RobustFit approach(surface, start, effort);
  const double scale = std::max(reach, tolerance::relative);
  approach.settle(scale, scale);
  return approach.symmetry;
}

Symmetry refine_symmetry(const SymmetrySurface& surface, const Symmetry& start, double reach) {
  RobustFit approach(surface, start, Effort::dense);
  const double first = std::max(reach, tolerance::relative);
  for (double scale = first; approach.settle(scale, first); scale *= shrink) {
    const Linearization& at = approach.at;
    const bool exact = at.distances.cwiseProduct(at.weights(scale)).maxCoeff() < tolerance::relative;
    if (exact || scale * shrink < tolerance::relative ||
        share(at.information(scale * shrink), at.information(first)) < min_information_share)
      break;
  }
  return approach.symmetry;
}

}  // namespace stackabilization::detail
