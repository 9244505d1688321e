#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// Corners of a convex polygon in the plane, in order, either orientation; may degenerate to a segment or a
/// point.
using ConvexPolygon = std::vector<Eigen::Vector2d>;

/// Returns the outline of coplanar points in order (k x 3), seen along the third axis of `frame`.
ConvexPolygon outline_of(const Points& points, const Frame& frame);

/// Returns the outline of a triangle, row of Shape::triangles, seen along the third axis of `frame`.
ConvexPolygon outline_of(const Shape& shape, std::int32_t triangle, const Frame& frame);

/// Returns the area of a convex outline, positive when its corners are counter-clockwise.
double signed_area(const ConvexPolygon& outline);
double outline_area(const ConvexPolygon& outline);

/// Returns whether all corners of a convex outline lie in another one, border included. False for an outer
/// one without area. In double precision.
bool contains(const ConvexPolygon& outer, const ConvexPolygon& inner);

/// Returns weights of the corners whose combination is the centroid of the area, or of the corners when the
/// area is zero.
Eigen::VectorXd outline_centroid(const ConvexPolygon& outline);

/// Returns the connected components of outlines, as indices. Two outlines are adjacent when they come within
/// `reach` of each other. Components are ordered by their smallest index, members ascend.
std::vector<std::vector<std::size_t>> connected_outlines(const std::vector<ConvexPolygon>& outlines,
                                                         double reach);

/// Computes the area of the union of the outlines. Up to 4096 outlines are united on a grid of 2^30 cells
/// across. More outlines are measured along 2048 scan lines, to within about a thousandth of the rectangle
/// around them; fewer lines are used when more than 2^24 intersections would be needed.
double union_area(const std::vector<ConvexPolygon>& outlines);

/// Computes the area of the largest hole of the union, on a bitmap of 254 cells across in which every touched
/// cell is covered. The accuracy suffices to distinguish a ring from a disc. Narrow gaps between neighbours
/// are not holes.
double largest_hole(const std::vector<ConvexPolygon>& outlines);

/// Minimal-area rectangle around all corners: the lengths of its longer and its shorter side, and the unit
/// direction of the longer side.
struct Elongation {
  double length = 0, width = 0;
  Eigen::Vector2d axis = Eigen::Vector2d::UnitX();
};
Elongation elongation_of(const std::vector<ConvexPolygon>& outlines);

}  // namespace stackabilization::detail
