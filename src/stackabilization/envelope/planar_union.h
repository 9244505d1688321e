#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace stackabilization::detail {

/// Corners of a convex polygon in the plane, in order, either orientation; may degenerate to a segment or a point.
using Outline = std::vector<Eigen::Vector2d>;

double outline_area(const Outline& outline);

/// Barycentric weights of the corners whose combination is the centroid of the area (of the corners if that is zero).
Eigen::VectorXd outline_centroid(const Outline& outline);

/// Indices of outlines that hang together: two are neighbours when they come within `reach` of each other. Components
/// by their smallest index, members ascending.
std::vector<std::vector<std::size_t>> connected_outlines(const std::vector<Outline>& outlines, double reach);

/// Union of the outlines, on an integer grid of 2^30 cells across: area, and the area of the largest hole after cracks
/// of a few cells are closed.
struct PlanarUnion {
  double area = 0;
  double largest_hole = 0;
};
PlanarUnion unite(const std::vector<Outline>& outlines);

/// Minimal-area rectangle around all corners: its longer side and the unit direction of that side.
struct Elongation {
  double length = 0, width = 0;
  Eigen::Vector2d axis = Eigen::Vector2d::UnitX();
};
Elongation elongation_of(const std::vector<Outline>& outlines);

}  // namespace stackabilization::detail
