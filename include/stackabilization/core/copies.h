#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// A placed copy of a shape: p -> rotation * p + translation, each coordinate rounded to double.
struct PlacedCopy {
  std::string name;                                        ///< UTF-8; parts of the copy are named "NAME/PART"
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< orthogonal, determinant +1
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();   ///< model units
  std::size_t shape = 0;                                   ///< index into Copies::shapes
};

/// Copies of one shape, or of a few.
struct Copies {
  std::vector<Shape> shapes;       ///< in their own coordinates, of one unit; at least one
  std::vector<PlacedCopy> placed;  ///< copies with different names
};

/// Returns all copies as one shape, in their order. Throws InputError when a shape is invalid or names
/// repeat. Throws UsageError when the result has more vertices or triangles than can be indexed.
Shape as_one_shape(const Copies& copies);

}  // namespace stackabilization
