#include "deformation/controllers/primitive_validity.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <vector>

#include "stackabilization/core/tolerances.h"
#include "stackabilization/deformation/tolerances.h"

namespace stackabilization::detail {

namespace {

/// Returns whether the controls are so far within the range of coordinates that the surface, which extends
/// beyond them, is within it too.
template <class Numbers>
bool in_range(const Numbers& numbers) {
  return (numbers.array().abs() <= tolerance::collapse * tolerance::max_coordinate).all();
}

/// Returns, as columns, the edges at the corner along the three axes of the box, all in their positive
/// direction.
Eigen::Matrix3d edges_at(const Cuboid& cuboid, int corner) {
  Eigen::Matrix3d edges;
  for (int a = 0; a < 3; ++a)
    edges.col(a) = (cuboid.corners.row(corner | 1 << a) - cuboid.corners.row(corner & ~(1 << a))).transpose();
  return edges;
}

/// Returns the axes along which the cuboid extends at rest.
std::vector<int> extended_axes(const Cuboid& rest) {
  const Eigen::RowVector3d lengths = edges_at(rest, 0).colwise().norm();
  std::vector<int> axes;
  for (int a = 0; a < 3; ++a)
    if (lengths(a) > tolerance::relative * lengths.maxCoeff()) axes.push_back(a);
  return axes;
}

/// Returns the volume, area or length at a corner divided by that at rest; negative where the orientation is
/// reversed.
double measure_ratio(const Eigen::Matrix3d& rest, const Eigen::Matrix3d& now, const Eigen::Vector3d& side,
                     const std::vector<int>& axes) {
  if (axes.size() == 3) return now.determinant() / rest.determinant();
  if (axes.size() == 1) return now.col(axes[0]).norm() / rest.col(axes[0]).norm();
  const Eigen::Vector3d area = now.col(axes[0]).cross(now.col(axes[1]));
  return area.dot(side) / (side.norm() * rest.col(axes[0]).cross(rest.col(axes[1])).norm());
}

std::optional<Refusal> defect_of(const Cuboid& rest, const Cuboid& now) {
  if (!in_range(now.corners)) return Refusal{.cause = RefusalCause::primitive_range};
  const std::vector<int> axes = extended_axes(rest);
  Eigen::Vector3d side = Eigen::Vector3d::Zero();
  if (axes.size() == 2)
    for (int corner = 0; corner < 8; ++corner)
      side += edges_at(now, corner).col(axes[0]).cross(edges_at(now, corner).col(axes[1]));
  for (int corner = 0; corner < 8 && !axes.empty(); ++corner) {
    const double ratio = measure_ratio(edges_at(rest, corner), edges_at(now, corner), side, axes);
    if (!(ratio > tolerance::collapse))
      return Refusal{.cause = ratio < 0 ? RefusalCause::inverted_corner : RefusalCause::collapsed_corner,
                     .index = corner};
  }
  return std::nullopt;
}

std::optional<Refusal> defect_of(const GeneralizedCylinder& rest, const GeneralizedCylinder& now) {
  if (!in_range(now.centres) || !in_range(now.radii) || !now.rotation.coeffs().allFinite())
    return Refusal{.cause = RefusalCause::primitive_range};
  const int n = static_cast<int>(rest.centres.rows());
  const Eigen::Quaterniond whole = now.rotation * rest.rotation.inverse();
  const Points tangents = section_tangents(now), rest_tangents = section_tangents(rest);
  for (int i = 0; i < n; ++i) {
    if (!(now.radii(i) > tolerance::collapse * rest.radii(i)))
      return Refusal{.cause = RefusalCause::collapsed_radius, .index = i};
    const int next = (i + 1) % n;
    if (next == 0 && !rest.closed) break;
    const Eigen::Vector3d before = whole * (rest.centres.row(next) - rest.centres.row(i)).transpose();
    const Eigen::Vector3d piece = (now.centres.row(next) - now.centres.row(i)).transpose();
    const Refusal folds{.cause = RefusalCause::folded_piece, .index = i};
    if (!(piece.norm() > tolerance::collapse * before.norm()))
      return Refusal{.cause = RefusalCause::collapsed_piece, .index = i};
    if (!(piece.dot(before) > 0)) return folds;
    const Eigen::RowVector3d rest_piece = rest.centres.row(next) - rest.centres.row(i);
    for (const int k : {i, next})
      if (rest_tangents.row(k).dot(rest_piece) > 0 && !(tangents.row(k).dot(piece) > 0)) return folds;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Refusal> defect(const Primitive& rest, const Primitive& now) {
  if (const auto* cuboid = std::get_if<Cuboid>(&rest)) return defect_of(*cuboid, std::get<Cuboid>(now));
  return defect_of(std::get<GeneralizedCylinder>(rest), std::get<GeneralizedCylinder>(now));
}

}  // namespace stackabilization::detail
