#pragma once

#include <gmpxx.h>

#include "stackabilization/core/rational.h"

namespace stackabilization {

/// What a Rational holds. Only source files that compute with GMP include this header.
struct Rational::Number {
  mpq_class value;  ///< canonical
};

}  // namespace stackabilization
