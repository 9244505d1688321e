#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "stackabilization/core/shape.h"
#include "support/solids.h"
#include "support/variants.h"

/// Solids for the tests of symmetry.
namespace stackabilization::solids {

inline Shape joined(const std::vector<Shape>& shapes) {
  Shape result = shapes.front();
  for (std::size_t k = 1; k < shapes.size(); ++k) result = concatenate(result, shapes[k]);
  return result;
}

/// Mirrored in x = 0: parts seat, back, leg_1 .. leg_4.
inline std::vector<Shape> chair_parts() {
  return {named(box({-2, -2, 4}, {2, 2, 4.5}), "seat"),      named(box({-2, 1.6, 4.5}, {2, 2, 9}), "back"),
          named(box({-2, -2, 0}, {-1.5, -1.5, 4}), "leg_1"), named(box({1.5, -2, 0}, {2, -1.5, 4}), "leg_2"),
          named(box({1.5, 1.5, 0}, {2, 2, 4}), "leg_3"),     named(box({-2, 1.5, 0}, {-1.5, 2, 4}), "leg_4")};
}
inline Shape chair() {
  return joined(chair_parts());
}

/// A round seat, the part "seat", on legs "leg_0", ... that are skewed: each leans along the rim. Mapped to
/// itself by the turn by 2 pi / legs about z, and by no reflection.
inline Shape skewed_stool(int legs) {
  std::vector<Shape> parts = {
      named(transformed(cylinder(2, 0.3, 48), Eigen::Matrix3d::Identity(), {0, 0, 4}), "seat")};
  for (int k = 0; k < legs; ++k) {
    const Eigen::Matrix3d turn =
        (Eigen::AngleAxisd(2 * std::numbers::pi * k / legs, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()))
            .toRotationMatrix();
    parts.push_back(named(transformed(box({1.2, -0.15, 0}, {1.4, 0.15, 4.2}), turn, Eigen::Vector3d::Zero()),
                          "leg_" + std::to_string(k)));
  }
  return joined(parts);
}

/// Half a ring in the plane y = 0 on the side +x: parts body and handle.
inline Shape cup_with_handle() {
  Shape ring = torus({2, 0.35, 32, 12});
  Eigen::Matrix3d upright;
  upright << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return concatenate(named(frustum_shell({}), "body"),
                     named(transformed(ring, upright, {4.2, 0, 4}), "handle"));
}

/// A bar of 2 x 1 x 5 around the z axis, its ends turned by 60 degrees against each other: three half turns.
inline Shape twisted_bar() {
  Shape bar = box({-1, -0.5, -2.5}, {1, 0.5, 2.5});
  for (int level = 0; level < 4; ++level) bar = subdivided(bar);
  for (Eigen::Index v = 0; v < bar.vertex_count(); ++v) {
    const double angle = 0.2 * bar.vertices(v, 2), c = std::cos(angle), s = std::sin(angle);
    const double u = bar.vertices(v, 0), w = bar.vertices(v, 1);
    bar.vertices(v, 0) = c * u - s * w;
    bar.vertices(v, 1) = s * u + c * w;
  }
  return bar;
}

inline Shape finely(Shape shape, int levels) {
  for (int level = 0; level < levels; ++level) shape = subdivided(shape);
  return shape;
}

/// Every vertex moved along each axis by up to `share` of the diagonal; those of equal coordinates together.
inline Shape noisy(Shape shape, double share, std::uint64_t seed) {
  const double diagonal = (shape.vertices.colwise().maxCoeff() - shape.vertices.colwise().minCoeff()).norm();
  Points rest = shape.vertices;
  for (Eigen::Index v = 0; v < rest.rows(); ++v) {
    std::uint64_t key = seed;
    for (int k = 0; k < 3; ++k)
      key = key * 1000003 + static_cast<std::uint64_t>(std::llround(rest(v, k) * 1e6) + (1LL << 40));
    Random random(key);
    shape.vertices.row(v) += share * diagonal * random.in_cube().transpose();
  }
  return shape;
}

inline std::vector<std::pair<std::string, Shape>> asymmetric_zoo() {
  std::vector<std::pair<std::string, Shape>> zoo;
  zoo.emplace_back("scalene tetrahedron", tetrahedron({{{0, 0, 0}, {4, 0, 0}, {1, 3, 0}, {0.5, 1, 2}}}));
  zoo.emplace_back("another tetrahedron", tetrahedron({{{0, 0, 0}, {5, 1, 0}, {2, 3, 1}, {-1, 1, 3}}}));
  // An L with unequal arms of unequal width, cut obliquely across its width.
  Shape angle = extruded_profile({{0, 0}, {4, 0}, {4, 0.7}, {1, 0.7}, {1, 2.5}, {0, 2.5}}, 2);
  for (Eigen::Index v = 0; v < angle.vertex_count(); ++v)
    if (angle.vertices(v, 1) > 1) angle.vertices(v, 1) += 0.3 * angle.vertices(v, 0);
  zoo.emplace_back("L with a slanted side", angle);
  zoo.emplace_back("box with a bump off its middle",
                   concatenate(box({4, 3, 2}), box({2.6, 0.4, 2}, {3.6, 1.1, 3})));
  zoo.emplace_back(
      "box with a dent off its middle",
      concatenate(prism({{0, 0}, {4, 0}, {4, 3}, {3.5, 3}, {3.5, 1.2}, {2.6, 1.2}, {2.6, 3}, {0, 3}}, 1.2),
                  box({0, 0, 1.2}, {4, 1, 2})));
  std::vector<Shape> missing = chair_parts();
  missing.pop_back();
  zoo.emplace_back("chair without a leg", joined(missing));
  std::vector<Shape> displaced = chair_parts();
  displaced.back() = moved(displaced.back(), {1, 0, 0});
  zoo.emplace_back("chair with a leg at another place", joined(displaced));
  std::vector<Shape> shorter = chair_parts();
  shorter.back() = named(box({-2, 1.5, 1.5}, {-1.5, 2, 4}), "leg_4");
  zoo.emplace_back("chair with a short leg", joined(shorter));
  zoo.emplace_back(
      "parallelepiped with an oblique stick",
      concatenate(transformed(box({3, 2, 1}),
                              (Eigen::Matrix3d() << 1, 0.4, 0.2, 0, 1, 0.5, 0, 0, 1).finished(), {0, 0, 0}),
                  box({2.5, 0.2, 0.9}, {2.9, 0.6, 3})));
  return zoo;
}

}  // namespace stackabilization::solids
