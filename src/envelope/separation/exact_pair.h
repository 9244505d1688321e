#pragma once

#include <optional>

#include "envelope/separation/separation_tree.h"
#include "envelope/separation/shear.h"

namespace stackabilization::detail {

/// Largest (a - b).r / r.r over points a of `upper` and b of `lower` on common lines along r, in rational
/// arithmetic; nothing when the projections have no common interior (solid) or no common point (closed).
std::optional<Rational> exact_maximum(const TreeTriangle& upper, const TreeTriangle& lower,
                                      const Shear& shear, ContactSemantics semantics);

/// Where that maximum is attained: the exact points, each coordinate rounded to the nearest double.
/// Precondition: there is a maximum.
struct ExactPoints {
  Eigen::Vector3d upper, lower;
};
ExactPoints exact_points(const TreeTriangle& upper, const TreeTriangle& lower, const Shear& shear,
                         ContactSemantics semantics);

}  // namespace stackabilization::detail
