#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "envelope/separation/separation_tree.h"
#include "envelope/separation/shear.h"
#include "stackabilization/core/rational.h"

/// Nodes of a tree without the margin that those of a SeparationTree have.
namespace stackabilization::tight_node {

inline Rational dot(const std::array<double, 3>& normal, const Eigen::Vector3d& point) {
  return Rational(normal[0]) * Rational(point[0]) + Rational(normal[1]) * Rational(point[1]) +
         Rational(normal[2]) * Rational(point[2]);
}

inline double rounded_down(const Rational& value) {
  const double nearest = value.to_double();
  return Rational(nearest) <= value ? nearest : std::nextafter(nearest, -detail::infinity);
}

inline double rounded_up(const Rational& value) {
  const double nearest = value.to_double();
  return Rational(nearest) >= value ? nearest : std::nextafter(nearest, detail::infinity);
}

/// A diagonal as a vector.
inline std::array<double, 3> direction_of(int diagonal) {
  std::array<double, 3> direction{};
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
    direction[static_cast<std::size_t>(axis)] = along_diagonal(unit.data(), diagonal);
  }
  return direction;
}

/// The smallest node with this normal of the slab around some points.
template <class Points>
TreeNode node_around(const Points& points, const Eigen::Vector3d& normal) {
  TreeNode node{};
  node.low.fill(detail::infinity);
  node.high.fill(-detail::infinity);
  node.diagonal_low.fill(std::numeric_limits<float>::infinity());
  node.diagonal_high.fill(-std::numeric_limits<float>::infinity());
  node.normal = {normal.x(), normal.y(), normal.z()};
  node.slab_low = detail::infinity;
  node.slab_high = -detail::infinity;
  for (const Eigen::Vector3d& point : points) {
    for (int axis = 0; axis < 3; ++axis) {
      node.low[axis] = std::min(node.low[axis], point[axis]);
      node.high[axis] = std::max(node.high[axis], point[axis]);
    }
    for (int diagonal = 0; diagonal < diagonal_count; ++diagonal) {
      const Rational along = dot(direction_of(diagonal), point);
      node.diagonal_low[diagonal] = std::min(node.diagonal_low[diagonal], single_below(rounded_down(along)));
      node.diagonal_high[diagonal] = std::max(node.diagonal_high[diagonal], single_above(rounded_up(along)));
    }
    const Rational offset = dot(node.normal, point);
    node.slab_low = std::min(node.slab_low, rounded_down(offset));
    node.slab_high = std::max(node.slab_high, rounded_up(offset));
  }
  return node;
}

}  // namespace stackabilization::tight_node
