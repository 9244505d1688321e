#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/separation.h"

namespace stackabilization {

/// A subgradient of the length of a separation, model units per model unit.
struct SeparationGradient {
  Eigen::Matrix3d upper;      ///< row i: by corner i of Witness::upper_triangle, of the shape below
  Eigen::Matrix3d lower;      ///< row i: by corner i of Witness::lower_triangle, of the shape above
  Eigen::Vector3d direction;  ///< by the direction r, whose length does not change the separation's
};

/// Computes a subgradient of sep(below, above, r) |r| by the corners of the two triangles of its witness and
/// by r. By all other vertices it is 0. When the two shapes are one, the gradient by a vertex is the sum over
/// the corners that it is. Away from kinks, where another pair of triangles or of edges attains the same
/// value, it is the gradient; at a kink it is that of one of the pairs: `separation_gradients` has them all.
///
/// The separation is the optimum of a linear programme over the points of the two triangles. Its gradient is
/// the multiplier n of the common line, n.r = 1, which is the normal of the plane between the triangles where
/// they touch, times the barycentric weights of the two points. Double precision.
///
/// `separation`: result of `separation` for these shapes and this direction. Throws UsageError when it is not
/// blocked, or one of the triangles is degenerate.
SeparationGradient separation_gradient(const Shape& below, const Shape& above, const Direction& direction,
                                       const Separation& separation);

/// Two points that attain a separation with a plane between their triangles, and the subgradient of the
/// length of the separation there: upper_weights[i] normal by corner i of the upper triangle, and
/// -lower_weights[i] normal by corner i of the lower one.
struct SeparationTouch {
  std::int32_t upper_triangle;    ///< triangle of the shape below
  std::int32_t lower_triangle;    ///< triangle of the shape above
  Eigen::Vector3d upper_weights;  ///< barycentric, of the point on the upper triangle; sum 1
  Eigen::Vector3d lower_weights;  ///< barycentric, of the point on the lower triangle; sum 1
  Eigen::Vector3d normal;         ///< of the plane, scaled so that normal.r = |r|; no unit
  Eigen::Vector3d direction;      ///< by the direction r, model units
};

/// Generators of the generalized gradient of a separation.
struct SeparationGradients {
  std::vector<SeparationTouch> touches;  ///< in the order of their triangles, upper ones first
  /// Whether these are all. Otherwise there are more than the limit, or a triangle without area, or one that
  /// is seen edge-on, touches as well.
  bool complete = true;
  /// Whether the touches of each pair of triangles have one plane. Otherwise a pair occurs once for each
  /// corner of the set of planes between its triangles.
  bool one_plane_each = true;
};

/// Input of `separation_gradients`: two shapes, or twice the same one.
struct GradientQuery {
  const SeparationTree& below;   ///< of the shape below
  const SeparationTree& above;   ///< of the shape above
  const Direction& direction;    ///< r
  const Separation& separation;  ///< of the two along r, in the semantics of the options
};

/// Definition of contact, and how many touches are looked for.
struct GradientOptions {
  ContactSemantics semantics = ContactSemantics::solid;  ///< semantics of the separation
  std::int64_t limit = 256;                              ///< largest number of touches, >= 1
};

/// Finds all pairs of triangles that attain a separation exactly, with all corners of the sets of points
/// where they do. The generalized gradient (Clarke) by the vertices and by r lies in the convex hull of the
/// touches' subgradients, where the separation is continuous. The one-sided derivative along any change of
/// vertices and r is at most the largest product with one of them, and equal to it when the result is
/// `complete` and has `one_plane_each`.
///
/// Which pairs touch is decided in rational arithmetic; weights and planes are double precision. A pair that
/// misses the separation by a rounding of its coordinates does not touch. Triangles with the same three
/// points count each. Deterministic. Throws UsageError when the separation is not blocked, or the limit is
/// below 1.
SeparationGradients separation_gradients(const GradientQuery& query, const GradientOptions& options = {});

}  // namespace stackabilization
