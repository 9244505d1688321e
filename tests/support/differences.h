#pragma once

#include <Eigen/Core>

#include "stackabilization/core/shape.h"
#include "support/catch.h"

/// How far as many points are from each other, row by row.
namespace stackabilization {

/// Largest difference of two coordinates.
inline double largest_difference(const Points& a, const Points& b) {
  REQUIRE(a.rows() == b.rows());
  return (a - b).cwiseAbs().maxCoeff();
}

/// Largest distance of two points.
inline double largest_distance(const Points& a, const Points& b) {
  REQUIRE(a.rows() == b.rows());
  return (a - b).rowwise().norm().maxCoeff();
}

}  // namespace stackabilization
