#pragma once

#include <exception>
#include <new>
#include <string>

#include "stackabilization/core/errors.h"

namespace stackabilization {

/// Returns one sentence about a failure in the user's words: that of an Error, and for exceptions of other
/// libraries, which speak to programmers, a sentence of this one.
inline std::string failure_sentence(const std::exception& failure) {
  if (dynamic_cast<const Error*>(&failure)) return failure.what();
  if (dynamic_cast<const std::bad_alloc*>(&failure)) return "this takes more memory than there is";
  return std::string("unexpected failure: ") + failure.what();
}

}  // namespace stackabilization
