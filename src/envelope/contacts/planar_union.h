#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace stackabilization::detail {

/// Corners of a convex polygon in the plane, in order, either orientation; may degenerate to a segment or a
/// point.
using ConvexPolygon = std::vector<Eigen::Vector2d>;

double outline_area(const ConvexPolygon& outline);

/// Barycentric weights of the corners whose combination is the centroid of the area (of the corners if that
/// is zero).
Eigen::VectorXd outline_centroid(const ConvexPolygon& outline);

/// Indices of outlines that hang together: two are neighbours when they come within `reach` of each other.
/// Components by their smallest index, members ascending.
std::vector<std::vector<std::size_t>> connected_outlines(const std::vector<ConvexPolygon>& outlines,
                                                         double reach);

/// Area of the union of the outlines: up to 4096 of them on a grid of 2^30 cells across; of more by
/// 2048 lines across, to within about a thousandth of the rectangle around them, or by fewer where so many
/// lie above each other that more than 2^24 cuts would be needed.
double union_area(const std::vector<ConvexPolygon>& outlines);

/// Area of the largest hole of the union, on a bitmap of 254 cells across in which every touched cell is
/// covered: good enough to tell a ring from a patch, and blind to cracks between neighbours.
double largest_hole(const std::vector<ConvexPolygon>& outlines);

/// Minimal-area rectangle around all corners: its longer side and the unit direction of that side.
struct Elongation {
  double length = 0, width = 0;
  Eigen::Vector2d axis = Eigen::Vector2d::UnitX();
};
Elongation elongation_of(const std::vector<ConvexPolygon>& outlines);

}  // namespace stackabilization::detail
