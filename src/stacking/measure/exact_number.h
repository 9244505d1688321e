#pragma once

#include <locale>
#include <sstream>
#include <string>

#include "stackabilization/core/rational.h"

namespace stackabilization {

/// Converts a rational to the exact number type of a CGAL kernel (GMP or Boost, by CGAL's configuration). The
/// conversion uses decimal text, the only form that all of these types share.
template <class Exact>
Exact to_exact(const Rational& value) {
  return Exact(value.numerator() + "/" + value.denominator());
}

/// Converts an exact number of CGAL to the Rational with the same value.
template <class Exact>
Rational from_exact(const Exact& value) {
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  stream << value;
  const std::string text = stream.str();
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) return {text, "1"};
  return {text.substr(0, slash), text.substr(slash + 1)};
}

}  // namespace stackabilization
