#pragma once

#include <optional>
#include <string>

#include "stackabilization/structure/primitive.h"

namespace stackabilization::detail {

/// What is wrong with a deformed primitive, as in "is turned inside out at corner 3", or nothing.
///
/// A cuboid must keep its orientation at every corner, and a fraction tolerance::collapse of its volume
/// there; one that is flat at rest the orientation of its faces, one that is a line its length. A generalized
/// cylinder must keep that fraction of every radius and piece of its curve; no piece may turn by a right
/// angle from where the rotation of the whole takes it, or run against the tangents at its ends where it did
/// not at rest. Everything must be finite.
std::optional<std::string> defect(const Primitive& rest, const Primitive& now);

}  // namespace stackabilization::detail
