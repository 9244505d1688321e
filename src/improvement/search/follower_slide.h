#pragma once

#include <optional>

#include "stackabilization/improvement/checks.h"
#include "stackabilization/improvement/contact_edits.h"

namespace stackabilization::detail {

/// Returns a move that lets another part keep its size while a part leans: a ring or a rung between legs
/// grows with its distance from the ends about which these turn. It slides along r towards those ends, so far
/// that its growth stays within the limit if it is proportional to that distance.
///
/// `refused`: why the leaning alone is refused. Nothing unless that is the size of a part that is neither the
/// leaning one nor symmetric to it, and lies between the ends of the leaning part along r.
std::optional<Edit> follower_slide(const ContactEdit& leaning, const Obstacle& refused,
                                   const StructuredShape& rest, const Design& now,
                                   const Direction& direction);

}  // namespace stackabilization::detail
