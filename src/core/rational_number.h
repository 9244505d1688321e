#pragma once

#include <gmpxx.h>

#include "stackabilization/core/rational.h"

namespace stackabilization {

/// The GMP number of a Rational. Only source files that compute with GMP include this header.
struct Rational::Number {
  mpq_class value;  ///< canonical
};

}  // namespace stackabilization
