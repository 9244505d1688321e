#pragma once

#include <Eigen/Core>
#include <array>

#include "stackabilization/mesh/boxes.h"
#include "structure/model/fit_error.h"

namespace stackabilization::detail {

/// Box of the cuboid of a part.
struct PartBox {
  /// Every half extent is at least half of `tolerance::min_thickness` of the diagonal.
  OrientedBox box;
  /// Whether the part has no extent in some direction. No generalized cylinder represents a flat part.
  bool flat = false;
  /// Whether a half extent was raised to the minimum.
  bool thickened = false;
};

/// Computes the box of a part: the minimal oriented box, or a better aligned box that fits nearly as well.
/// The candidates, in this order, are the box of the file's axes, boxes around the distinct axis of inertia,
/// boxes around an axis of the minimal box, and the minimal box. The file's axes determine the rotation of
/// the second and third kind. A candidate fits nearly as well with at most 5 % more volume and at most 20 %
/// more root mean square distance from the surface. Round and square parts of a model thus get consistent
/// boxes, and tapered parts get symmetric boxes. The order and the signs of the axes are the nearest ones to
/// the file's axes.
PartBox part_box(const FitSurface& part);

/// Returns the columns of `box.axes`, longest first. Of equally long axes (tolerance::relative) the later one
/// comes first.
std::array<int, 3> axes_by_length(const OrientedBox& box);

}  // namespace stackabilization::detail
