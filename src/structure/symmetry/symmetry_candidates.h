#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "structure/symmetry/symmetry_verification.h"

namespace stackabilization::detail {

/// |Cosine| up to which two axes count as across each other.
constexpr double nearly_across = 0.05;

/// The reflections (own frame) of a surface that is not one of revolution: voted for, or across an axis of
/// its box or of its second moments, or the image of one in another; refined and verified. Those across an
/// axis of the box come first, the longest extent before others, then the rest by residual.
std::vector<FoundSymmetry> find_reflections(const SymmetrySurface& surface, const SymmetryOptions& options);

/// The reflection (own frame) near `candidate`, with its measures; nothing when the surface has none there.
std::optional<FoundSymmetry> reflection_near(const SymmetrySurface& surface, const Symmetry& candidate,
                                             const SymmetryOptions& options);

/// The rotations (own frame) of such a surface, of the highest order about each axis, highest order first.
/// About the line that n of its reflections have in common the order is n; other axes are voted for, or those
/// of the box and of the second moments.
std::vector<FoundSymmetry> find_rotations(const SymmetrySurface& surface,
                                          const std::vector<FoundSymmetry>& reflections,
                                          const SymmetryOptions& options);

/// What may be called a surface of revolution.
enum class Roundness {
  /// It agrees with itself turned by any angle, without any detail that stands out.
  tolerant,
  /// And facets, where it faces sideways, stand out by less than one and a half tolerances of its radius:
  /// regular prisms of 14 sides and more are round, of 12 and less are not.
  faceted,
};

/// All axes (own frame) of revolution through, or near, the centroid; three for a sphere.
std::vector<Symmetry> revolutions(const SymmetrySurface& surface, const SymmetryOptions& options,
                                  Roundness roundness);

/// Can `axis` be the normal of a reflection or the axis of a rotation: is it one of the second moments,
/// nearly?
bool is_principal(const SymmetrySurface& surface, const Eigen::Vector3d& axis);

/// Axes of the second moments and of the box, in columns.
Eigen::Matrix<double, 3, 6> axes_of(const SymmetrySurface& surface);

}  // namespace stackabilization::detail
