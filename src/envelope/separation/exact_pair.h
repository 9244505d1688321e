#pragma once

#include <optional>
#include <vector>

#include "envelope/separation/separation_tree.h"
#include "envelope/separation/shear.h"

namespace stackabilization::detail {

/// Computes the largest (a - b).r / r.r over points a of `upper` and b of `lower` on common lines along r, in
/// rational arithmetic. Returns nothing when the projections have no common interior (solid) or no common
/// point (closed).
std::optional<Rational> exact_maximum(const TreeTriangle& upper, const TreeTriangle& lower,
                                      const Shear& shear, ContactSemantics semantics);

/// The points that attain that maximum, each exact coordinate rounded to the nearest double.
struct ExactPoints {
  Eigen::Vector3d upper, lower;
};
/// Computes these points. Precondition: `exact_maximum` returns a value.
ExactPoints exact_points(const TreeTriangle& upper, const TreeTriangle& lower, const Shear& shear,
                         ContactSemantics semantics);

/// The maximum, and all points that attain it at corners of the common columns; rounded as `exact_points`.
struct ExactMaximum {
  Rational value;
  std::vector<ExactPoints> points;  ///< no two are the same pair of points
};
/// Computes both; nothing where `exact_maximum` returns nothing.
std::optional<ExactMaximum> exact_maximum_with_points(const TreeTriangle& upper, const TreeTriangle& lower,
                                                      const Shear& shear, ContactSemantics semantics);

/// Returns whether the triangle projects to a segment or a point, in rational arithmetic.
bool is_edge_on(const TreeTriangle& triangle, const Shear& shear);

}  // namespace stackabilization::detail
