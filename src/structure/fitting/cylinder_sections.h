#pragma once

#include <optional>

#include "stackabilization/structure/primitive.h"
#include "structure/fitting/curve_skeleton.h"
#include "structure/fitting/revolution_axis.h"
#include "structure/model/fit_error.h"

namespace stackabilization::detail {

/// Smallest radius as a fraction of the largest one. A pointed end keeps a circle that can be scaled.
constexpr double min_relative_radius = 0.01;

/// Definition of the radius of a section across a straight axis.
enum class SectionRadius {
  /// Distance of the farthest point of the outline, but for what sticks out on one side: right for bodies of
  /// revolution at any tessellation.
  outermost,
  mean  ///< mean over all directions of the outermost distance: right for other outlines
};

/// Fits circles at equal steps along `axis`, from the lower end of the part (by z, y, x) to the other end.
/// The circles of a hollow body follow its outer wall. Returns nothing when the part has no extent along or
/// across the axis.
std::optional<GeneralizedCylinder> straight_cylinder(const Shape& part, const AxisLine& axis, int sections,
                                                     SectionRadius radius);

/// Fits, by least squares, the straight line through the middles of the outlines of the part across `axis`.
/// It serves parts that lean in their box. Returns nothing when fewer than half of the sections have an
/// outline.
std::optional<AxisLine> middle_line(const Shape& part, const AxisLine& axis, int sections);

/// Fits a closed cylinder around the axis of a body of revolution, through the middle of its profile. It runs
/// counter-clockwise about the upward direction of the axis. Returns nothing when the profile reaches the
/// axis.
std::optional<GeneralizedCylinder> ring_cylinder(const FitSurface& part, const AxisLine& axis, int sections);

/// Fits circles at equal arc lengths of a curve. First the curve moves to the middle of the part and, when
/// open, is extended to the ends of the part. The radius is the mean distance of the surface points whose
/// nearest curve point lies at the section. Returns nothing when the curve leaves the part.
std::optional<GeneralizedCylinder> curved_cylinder(const FitSurface& part, const Curve& curve, int sections);

}  // namespace stackabilization::detail
