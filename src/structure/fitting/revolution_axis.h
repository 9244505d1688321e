#pragma once

#include <Eigen/Core>
#include <optional>

#include "structure/model/fit_error.h"

namespace stackabilization::detail {

/// A line in space.
struct AxisLine {
  Eigen::Vector3d point;      ///< any point of the line, model units
  Eigen::Vector3d direction;  ///< unit vector
};

/// Computes the line that the surface normals intersect best, by least squares in line coordinates (Pottmann
/// and Randrup, Rotational and helical surface approximation, Computing 60, 1998). `weights`: one per
/// triangle, >= 0. The sums are integrals over the triangles; orientation and tessellation do not influence
/// them. Returns nothing where they overflow.
std::optional<AxisLine> axis_of_normals(const Shape& part, const Eigen::VectorXd& weights);

/// Computes the axis of a body of revolution, hollow or not: that of its normals. Returns nothing when the
/// part, rotated by several angles about the axis, deviates from itself by more than a regular octagon does.
std::optional<AxisLine> revolution_axis(const FitSurface& part);

}  // namespace stackabilization::detail
