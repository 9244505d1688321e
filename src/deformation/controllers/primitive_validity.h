#pragma once

#include <optional>

#include "stackabilization/deformation/refusal.h"

namespace stackabilization::detail {

/// Returns the defect of a deformed primitive, without its part. Returns nothing for a valid primitive.
///
/// At every corner, a cuboid must keep its orientation and the fraction tolerance::collapse of its volume. A
/// cuboid that is flat at rest must keep the orientation and that fraction of the area of its faces. A cuboid
/// that is a line at rest must keep that fraction of its length. A generalized cylinder must keep that
/// fraction of every radius and of every piece of its curve. No piece may turn by a right angle or more
/// against the rotation of the whole. No piece may run against the tangents at its ends, unless it does so at
/// rest. All numbers must be finite and within the range of coordinates.
std::optional<Refusal> defect(const Primitive& rest, const Primitive& now);

}  // namespace stackabilization::detail
