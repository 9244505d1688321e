#include "deformation/model/mean_value_coordinates.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>

#include "stackabilization/core/tolerances.h"

namespace stackabilization {

namespace {

using Weights = Eigen::Matrix<double, 8, 1>;

Eigen::Vector3d cube_corner(int k) {
  return {(k & 1) != 0 ? 1.0 : -1.0, (k & 2) != 0 ? 1.0 : -1.0, (k & 4) != 0 ? 1.0 : -1.0};
}

/// Largest distance from the centre, in half sides of the cube, at which the formula is used.
constexpr double reach = 2;

/// Moves the point within reach, and into the planes of the faces that it nearly lies in.
Eigen::Vector3d tamed(const Eigen::Vector3d& point) {
  Eigen::Vector3d tame = point.cwiseMax(-reach).cwiseMin(reach);
  for (double& x : tame)
    if (std::abs(std::abs(x) - 1) <= tolerance::relative) x = std::copysign(1.0, x);
  return tame;
}

/// Computes the weights of a point on the face across axis `a`: the mean over both diagonals of the
/// barycentric coordinates in the triangle that contains the point.
Weights face_coordinates(const Eigen::Vector3d& point, int a) {
  const int b = (a + 1) % 3, c = (a + 2) % 3;
  const double u = point(b), v = point(c);
  const int base = (point(a) > 0 ? 1 : 0) << a, along_b = base | 1 << b, along_c = base | 1 << c;
  const int across = along_b | along_c;
  Weights weights = Weights::Zero();
  weights(base) = (1 - std::max(u, v)) / 4 + std::max(-u - v, 0.0) / 4;
  weights(across) = (1 + std::min(u, v)) / 4 + std::max(u + v, 0.0) / 4;
  weights(along_b) = std::max(u - v, 0.0) / 4 + (1 - std::max(-u, v)) / 4;
  weights(along_c) = std::max(v - u, 0.0) / 4 + (1 + std::min(-u, v)) / 4;
  return weights;
}

/// Adds up the weights of the triangles of the cage, as seen from a point. Edges enter both of their
/// triangles with the same numbers, so that the sum of the mean vectors vanishes and linear precision
/// survives rounding.
class SeenCube {
 public:
  explicit SeenCube(const Eigen::Vector3d& point) : point_(point) {
    for (int k = 0; k < 8; ++k) ray_[static_cast<std::size_t>(k)] = cube_corner(k) - point;
    for (int face = 0; face < 6; ++face) {
      const std::array<int, 4> ring = cuboid_face(face);
      for (const auto [i, j] :
           std::array<std::array<std::size_t, 2>, 6>{{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}, {1, 3}}})
        prepare(ring[i], ring[j]);
    }
  }

  Weights weights() const {
    Weights sum = Weights::Zero();
    for (int face = 0; face < 6; ++face) {
      const double height = 1 - (face % 2 == 1 ? 1 : -1) * point_(face / 2);
      if (height == 0) continue;  // the point lies in the plane of the face, outside of it
      const std::array<int, 4> r = cuboid_face(face);
      for (const auto& [i, j, k] : std::array<std::array<int, 3>, 4>{
               {{r[0], r[1], r[2]}, {r[0], r[2], r[3]}, {r[1], r[2], r[3]}, {r[1], r[3], r[0]}}})
        add_triangle({i, j, k}, height, sum);
    }
    return sum / sum.sum();
  }

 private:
  const Eigen::Vector3d& ray(int k) const { return ray_[static_cast<std::size_t>(k)]; }
  static std::size_t slot(int i, int j) { return static_cast<std::size_t>(8 * i + j); }

  /// Computes the cross product of the rays to two corners from the exact difference of the corners, and the
  /// unit normal times the angle between the rays.
  void prepare(int i, int j) {
    const Eigen::Vector3d cross = ray(i).cross(cube_corner(j) - cube_corner(i));
    const double length = cross.norm();
    Eigen::Vector3d arc = Eigen::Vector3d::Zero();
    if (length > 0) arc = std::atan2(length, ray(i).dot(ray(j))) / length * cross;
    cross_[slot(i, j)] = cross;
    cross_[slot(j, i)] = -cross;
    arc_[slot(i, j)] = arc;
    arc_[slot(j, i)] = -arc;
  }

  /// Ju et al., equation 9: the mean vector of the spherical triangle, as a combination of the rays. The
  /// determinant of the rays is four times the height over the face for every triangle of the cube.
  void add_triangle(const std::array<int, 3>& corners, double height, Weights& sum) const {
    const auto& [i, j, k] = corners;
    const Eigen::Vector3d mean = arc_[slot(i, j)] + arc_[slot(j, k)] + arc_[slot(k, i)];
    sum(i) += mean.dot(cross_[slot(j, k)]) / height;
    sum(j) += mean.dot(cross_[slot(k, i)]) / height;
    sum(k) += mean.dot(cross_[slot(i, j)]) / height;
  }

  Eigen::Vector3d point_;
  std::array<Eigen::Vector3d, 8> ray_;
  std::array<Eigen::Vector3d, 64> cross_, arc_;
};

}  // namespace

Weights cube_coordinates(const Eigen::Vector3d& point) {
  const Eigen::Vector3d at = tamed(point);
  const bool inside = at.cwiseAbs().maxCoeff() <= 1;
  Weights weights;
  Eigen::Index axis = 0;
  if (inside && at.cwiseAbs().maxCoeff(&axis) == 1)
    weights = face_coordinates(at, static_cast<int>(axis));
  else
    weights = SeenCube(at).weights();
  if (const Eigen::Vector3d rest = point - at; !rest.isZero(0))
    for (int k = 0; k < 8; ++k) weights(k) += cube_corner(k).dot(rest) / 8;
  return weights;
}

CornerWeights mean_value_coordinates(const Cuboid& rest, const Points& points) {
  const Eigen::Vector3d centre = rest.corners.colwise().mean();
  Eigen::Matrix3d half_axes = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 8; ++k)
    half_axes += (rest.corners.row(k).transpose() - centre) * cube_corner(k).transpose() / 8;
  Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix3d> solver;
  solver.setThreshold(tolerance::relative);
  solver.compute(half_axes);
  const Eigen::Matrix3d to_cube = solver.pseudoInverse();
  CornerWeights weights(8, points.rows());
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    weights.col(i) = cube_coordinates(to_cube * (points.row(i).transpose() - centre));
  return weights;
}

}  // namespace stackabilization
