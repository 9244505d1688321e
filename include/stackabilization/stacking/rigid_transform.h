#pragma once

#include <Eigen/Core>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"

namespace stackabilization {

/// The map p -> rotation * p + translation. `rotation` is a proper rotation (determinant +1).
struct RigidTransform {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< orthogonal, determinant +1
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();   ///< model units
};

/// A line in space: all points `point + t axis`.
struct Line {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< model units
  Direction axis{0, 0, 1};                          ///< any length
};

/// Throws UsageError unless all entries are finite and `rotation` is a rotation within tolerance::relative.
void validate(const RigidTransform& transform);

/// Returns the angle in (-180, 180] that differs from `degrees` by full turns. Exact. Throws UsageError
/// unless finite.
double reduced_degrees(double degrees);

/// Returns the right-handed rotation about a line. For multiples of a quarter turn about a coordinate axis,
/// the entries are exactly 0 and +-1; coordinates with exact sums are then not rounded. Throws UsageError
/// unless `degrees` is finite.
RigidTransform rotation_about(const Line& line, double degrees);

/// Returns the transform that applies `first`, then `second`. Entries are rounded to double.
RigidTransform composed(const RigidTransform& second, const RigidTransform& first);

/// Returns the transforms T^0, T^1, ..., T^(count - 1). Throws UsageError when `transform` is not rigid or
/// `count` < 1.
std::vector<RigidTransform> powers(const RigidTransform& transform, int count);

/// Returns the transformed shape, each coordinate rounded to double.
Shape transformed(const Shape& shape, const RigidTransform& transform);

}  // namespace stackabilization
