#include "structure/fitting/part_box.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "mesh/surface_moments.h"
#include "stackabilization/core/direction.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/structure/tolerances.h"
#include "structure/model/canonical_axes.h"

namespace stackabilization::detail {

namespace {

constexpr double volume_slack = 1.05;
constexpr double distance_slack = 1.2;

/// Orders and signs the same three lines, such that the frame is right-handed and as near to the identity as
/// possible.
Eigen::Matrix3d canonical(const Eigen::Matrix3d& axes) {
  Eigen::Matrix3d best = axes;
  double best_trace = -std::numeric_limits<double>::infinity();
  std::array<int, 3> order{0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Eigen::Matrix3d turned;
      for (int k = 0; k < 3; ++k)
        turned.col(k) = ((signs >> k) & 1 ? -1.0 : 1.0) * axes.col(order[static_cast<std::size_t>(k)]);
      // Frames that are equally near up to rounding are chosen by their order here, not by rounding.
      if (turned.determinant() < 0 || turned.trace() <= best_trace + tolerance::relative) continue;
      best = turned;
      best_trace = turned.trace();
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

OrientedBox box_with_axes(const Points& points, const Eigen::Matrix3d& axes) {
  const Eigen::RowVector3d origin = points.row(0);
  const Points local = (points.rowwise() - origin) * axes;
  const Eigen::Vector3d low = local.colwise().minCoeff(), high = local.colwise().maxCoeff();
  return {origin.transpose() + axes * (low + high) / 2, axes, (high - low) / 2};
}

/// The frame with its third axis along `pole` that lies nearest to the file's.
Eigen::Matrix3d turned_to_file(const Eigen::Vector3d& pole) {
  Eigen::Matrix3d axes;
  axes.col(2) = pole;
  axes.col(0) = orthogonal_axis(pole);
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

/// The axis of inertia whose moment differs most from the next one.
Eigen::Vector3d distinct_axis(const Eigen::Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  const Eigen::Vector3d moments = solver.eigenvalues();
  return solver.eigenvectors().col(moments(2) - moments(1) > moments(1) - moments(0) ? 2 : 0);
}

/// Axes in the order in which they are preferred; the last are those of the minimal box.
std::vector<Eigen::Matrix3d> candidate_axes(const HullSupport& hull, const Eigen::Matrix3d& covariance) {
  std::vector<Eigen::Matrix3d> axes{Eigen::Matrix3d::Identity()};
  const Eigen::Vector3d pole = distinct_axis(covariance);
  axes.push_back(turned_to_file(pole));
  axes.push_back(hull.box_along(Direction(pole)).axes);
  const Eigen::Matrix3d minimal = minimal_oriented_box(hull).axes;
  for (int k = 0; k < 3; ++k) axes.push_back(turned_to_file(minimal.col(k)));
  axes.push_back(minimal);
  return axes;
}

}  // namespace

PartBox part_box(const FitSurface& part) {
  const HullSupport hull(part.shape);
  const std::vector<Eigen::Matrix3d> candidates =
      candidate_axes(hull, SurfaceMoments(part.shape, part.shape.corner(0, 0)).covariance());
  const auto thickened = [&](const Eigen::Matrix3d& axes) {
    OrientedBox box = box_with_axes(hull.points(), canonical(axes));
    const double diagonal = 2 * box.half_extents.norm();
    box.half_extents = box.half_extents.cwiseMax(tolerance::min_thickness * diagonal / 2);
    return box;
  };
  OrientedBox box = thickened(candidates.back());
  const double volume = volume_slack * box.volume();
  const double distance =
      distance_slack * distance_to_surface(box, part) + tolerance::relative * box.half_extents.norm();
  for (const Eigen::Matrix3d& axes : candidates) {
    const OrientedBox candidate = thickened(axes);
    if (candidate.volume() > volume || distance_to_surface(candidate, part) > distance) continue;
    box = candidate;
    break;
  }
  const Eigen::Vector3d extents = box_with_axes(hull.points(), box.axes).half_extents;
  return {box, extents.minCoeff() <= tolerance::relative * extents.norm(), extents != box.half_extents};
}

std::array<int, 3> axes_by_length(const OrientedBox& box) {
  std::array<int, 3> axes{2, 1, 0};
  const double step = tolerance::relative * box.half_extents.norm();
  const auto length = [&](int k) { return std::round(box.half_extents(k) / step); };
  std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return length(a) > length(b); });
  return axes;
}

}  // namespace stackabilization::detail
