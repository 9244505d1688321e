#pragma once

#include <optional>

#include "stackabilization/envelope/separation.h"

namespace stackabilization {

/// f_max by another road: every pair of triangles is clipped, one against the other, in rational arithmetic,
/// and the height difference is looked up at the corners of what is left. No tree, no filter, no shared code
/// with the library but the number type. In units of r, solid semantics; nothing when no pair has common
/// area.
std::optional<Rational> oracle_separation(const Shape& below, const Shape& above, const Direction& direction);

/// The same for one triangle of each.
std::optional<Rational> oracle_pair(const Shape& below, Eigen::Index upper, const Shape& above,
                                    Eigen::Index lower, const Direction& direction);

}  // namespace stackabilization
