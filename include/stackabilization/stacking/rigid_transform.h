#pragma once

#include <Eigen/Core>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"

namespace stackabilization {

/// p -> rotation * p + translation, model units. `rotation` is a proper rotation (determinant +1).
struct RigidTransform {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< orthogonal, determinant +1
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();   ///< model units
};

/// A line in space: every point `point + t axis`, model units.
struct Line {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< model units
  Direction axis{0, 0, 1};                          ///< any length
};

/// Throws UsageError unless all entries are finite and `rotation` is a rotation within tolerance::relative.
void validate(const RigidTransform& transform);

/// The angle that differs from `degrees` by whole turns and lies in (-180, 180]. Exact. Throws UsageError
/// unless finite.
double reduced_degrees(double degrees);

/// Right-handed rotation about a line. Multiples of a quarter turn about a coordinate axis have entries 0 and
/// +-1 exactly, so that they lose nothing on coordinates whose sums are exact. Throws UsageError unless
/// `degrees` is finite.
RigidTransform rotation_about(const Line& line, double degrees);

/// First `first`, then `second`, entries rounded to double.
RigidTransform composed(const RigidTransform& second, const RigidTransform& first);

/// The transforms T^0, T^1, ..., T^(count - 1). Throws UsageError when `transform` is not rigid or `count`
/// < 1.
std::vector<RigidTransform> powers(const RigidTransform& transform, int count);

/// The shape moved rigidly, each coordinate rounded to double.
Shape transformed(const Shape& shape, const RigidTransform& transform);

}  // namespace stackabilization
