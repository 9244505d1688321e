#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "support/point_sets.h"

/// Sets of points that are flat, straight, one, or a little thicker than that, in many poses and units: what
/// the hull and all that is measured on it must survive.
namespace point_sets {

struct NearlyFlat {
  std::string name;
  Points points;
  /// Exact affine dimension, -1 where the pose rounds coordinates and so may raise it.
  int dimension = -1;
};

/// Thicknesses as fractions of the extent, down to none.
inline std::vector<double> thicknesses() {
  return {1e-3, 1e-8, 1e-12, 1e-13, 1e-16, std::numeric_limits<double>::denorm_min(), 0};
}

/// A lattice of 4 x 3 points in z = 0 with every other one lifted by `thickness`, points repeated, negative
/// zeros among them.
inline Points lifted_lattice(double thickness) {
  Points points(26, 3);
  for (int k = 0; k < 24; ++k) {
    const int x = k % 4, y = k / 4 % 3;
    points.row(k) << x, (x + y == 0 ? -0.0 : y), (x * x + y) % 2 == 0 ? -0.0 : thickness;
  }
  points.row(24) << 1, 1, thickness / 2;
  points.row(25) << -0.0, 0, -0.0;
  return points;
}

inline Points line(double lift) {
  Points points(6, 3);
  for (int k = 0; k < 6; ++k) points.row(k) << k % 5, 2 * (k % 5), (k == 2 ? lift : 0);
  return points;
}

inline Points one_point(double shift) {
  Points points = Points::Constant(5, 3, 0.75);
  points(3, 1) += shift;
  return points;
}

/// As they are, along other axes of the file, and in turned poses that round every coordinate.
inline std::vector<std::pair<std::string, Eigen::Matrix3d>> poses() {
  Eigen::Matrix3d cyclic;
  cyclic << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  const Eigen::Matrix3d upright =
      Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitX()).toRotationMatrix();
  std::vector<std::pair<std::string, Eigen::Matrix3d>> result = {{"as it is", Eigen::Matrix3d::Identity()},
                                                                 {"axes renamed", cyclic},
                                                                 {"axes renamed twice", cyclic * cyclic},
                                                                 {"turned up", upright}};
  Random random(31);
  for (int k = 0; k < 6; ++k) result.emplace_back("turned " + std::to_string(k), random.rotation());
  return result;
}

inline std::vector<NearlyFlat> nearly_flat_sets() {
  std::vector<NearlyFlat> sets;
  const auto all_poses = poses();
  const auto add = [&](const std::string& name, const Points& points, int dimension) {
    for (const double unit : {1.0, 1e-150, 1e150, 0x1p-490, 0x1p490})
      for (std::size_t p = 0; p < all_poses.size(); ++p) {
        const auto& [pose, rotation] = all_poses[p];
        const bool exact = p < 3 && (unit == 1 || unit == 0x1p-490 || unit == 0x1p490);
        sets.push_back({name + ", " + pose + ", unit " + std::to_string(std::log10(unit)),
                        moved(points, rotation, Eigen::Vector3d::Zero()) * unit, exact ? dimension : -1});
        if (p > 3)
          sets.push_back({name + ", away, " + pose, moved(points, rotation, {10, -7, 3}) * unit, -1});
      }
  };
  for (const double thickness : thicknesses()) {
    const std::string by = std::to_string(std::log10(thickness));
    // Units of 2^-490 lose a denormal thickness.
    const bool kept = thickness != std::numeric_limits<double>::denorm_min();
    add("lattice lifted by " + by, lifted_lattice(thickness), !kept ? -1 : thickness > 0 ? 3 : 2);
    add("line lifted by " + by, line(thickness), !kept ? -1 : thickness > 0 ? 2 : 1);
    add("point moved by " + by, one_point(thickness), 0.75 + thickness > 0.75 ? 1 : 0);
  }
  Points single(1, 3);
  single << 2, -0.0, 3;
  add("single point", single, 0);
  add("tetrahedron", tetrahedron(), 3);
  return sets;
}

}  // namespace point_sets
