#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "structure/symmetry/symmetry_verification.h"

namespace stackabilization::detail {

/// Largest |cosine| of the angle between two axes that count as perpendicular.
constexpr double nearly_across = 0.05;

/// Finds the reflections (own frame) of a surface that is not a surface of revolution. The candidates come
/// from votes, from the axes of the box and of the second moments, and as images of one reflection in
/// another. They are refined and verified. Reflections across an axis of the box come first, longest extent
/// first, then the others by residual.
std::vector<FoundSymmetry> find_reflections(const SymmetrySurface& surface, const SymmetryOptions& options);

/// Returns the reflection (own frame) near `candidate` with its residual and support, or nothing when the
/// surface has none there.
std::optional<FoundSymmetry> reflection_near(const SymmetrySurface& surface, const Symmetry& candidate,
                                             const SymmetryOptions& options);

/// Finds the rotations (own frame) of a surface that is not a surface of revolution, with the highest order
/// about each axis, highest order first. n reflections through a common line give the order n about that
/// line. Other axes come from votes, or from the box and the second moments.
std::vector<FoundSymmetry> find_rotations(const SymmetrySurface& surface,
                                          const std::vector<FoundSymmetry>& reflections,
                                          const SymmetryOptions& options);

/// Criterion for a surface of revolution.
enum class Roundness {
  /// The surface agrees with itself after rotation by any angle, without detail that deviates.
  tolerant,
  /// In addition, facets that face sideways deviate by less than one and a half tolerances of the radius.
  /// Regular prisms of 14 sides and more are round, prisms of 12 and fewer sides are not.
  faceted,
};

/// Returns all axes of revolution (own frame) through or near the centroid; three for a sphere.
std::vector<Symmetry> revolutions(const SymmetrySurface& surface, const SymmetryOptions& options,
                                  Roundness roundness);

/// Returns whether `axis` is nearly an axis of the second moments. Only such an axis can be the normal of a
/// reflection or the axis of a rotation.
bool is_principal(const SymmetrySurface& surface, const Eigen::Vector3d& axis);

/// Returns the axes of the second moments and of the box, as columns.
Eigen::Matrix<double, 3, 6> axes_of(const SymmetrySurface& surface);

}  // namespace stackabilization::detail
