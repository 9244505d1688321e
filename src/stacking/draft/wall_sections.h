#pragma once

#include <Eigen/Core>
#include <vector>

namespace stackabilization::detail {

/// What an upright plane has in common with a triangle, a segment: where it is along the plane, and its
/// heights there.
struct PlaneSection {
  double from, to, height_from, height_to;  ///< model units, from <= to

  /// Returns the height at `s`. Precondition: from < to.
  double at(double s) const { return height_from + (s - from) / (to - from) * (height_to - height_from); }
};

/// Returns the section from one point to another; `along` is the horizontal unit vector of the plane.
PlaneSection plane_section(const Eigen::Vector3d& along, const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// The area between two heights at `from` and two at `to`.
struct Trapezoid {
  double from, to, low_from, low_to, high_from, high_to;  ///< model units
};

/// Returns the area between the lower and the upper envelope of sections, from left to right: what has a
/// section below and another one above. Upright sections are ignored. O(n^2) where many overlap.
std::vector<Trapezoid> area_between(std::vector<PlaneSection> sections);

}  // namespace stackabilization::detail
