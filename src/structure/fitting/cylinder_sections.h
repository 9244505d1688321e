#pragma once

#include <optional>

#include "stackabilization/structure/primitive.h"
#include "structure/fitting/curve_skeleton.h"
#include "structure/fitting/revolution_axis.h"
#include "structure/model/fit_error.h"

namespace stackabilization::detail {

/// A radius is at least this fraction of the largest one: pointed ends keep a circle that can be scaled.
constexpr double min_relative_radius = 0.01;

/// What a circle across a straight axis takes from the outline of the part there.
enum class SectionRadius {
  outermost,  ///< the distance of its farthest point: right for bodies of revolution, however finely cut
  mean        ///< the mean over all directions of the outermost distance: right for other outlines
};

/// Circles at even heights along `axis` from the lower end of the part (by z, y, x) to the other; of a hollow
/// body its outer wall. Nothing when the part has no extent along or across the axis.
std::optional<GeneralizedCylinder> straight_cylinder(const Shape& part, const AxisLine& axis, int sections,
                                                     SectionRadius radius);

/// The straight line nearest to the middles of the part's outlines across `axis`, for legs that lean in their
/// box: least squares. Nothing when fewer than half of the sections have an outline.
std::optional<AxisLine> middle_line(const Shape& part, const AxisLine& axis, int sections);

/// A closed one around the axis of a body of revolution, through the middle of its profile,
/// counter-clockwise about its upward side. Nothing when the profile reaches the axis.
std::optional<GeneralizedCylinder> ring_cylinder(const FitSurface& part, const AxisLine& axis, int sections);

/// Circles at even arc lengths of a curve that is first moved to the middle of the part and, when open,
/// extended to its ends; the radius is the mean distance of the surface whose nearest point of the curve is
/// there. Nothing when the curve leaves the part.
std::optional<GeneralizedCylinder> curved_cylinder(const FitSurface& part, const Curve& curve, int sections);

}  // namespace stackabilization::detail
