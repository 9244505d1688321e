#pragma once

#include "stackabilization/envelope/separation.h"
#include "support/catch.h"

namespace stackabilization {

/// In units of the direction vector.
inline Rational exact_f_max(const Shape& shape, const Direction& direction,
                            ContactSemantics semantics = ContactSemantics::solid) {
  const Separation found = minimal_stacking_translation(shape, direction, {semantics, {}});
  REQUIRE(found.blocked);
  return found.value;
}

}  // namespace stackabilization
