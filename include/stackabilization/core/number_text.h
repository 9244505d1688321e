#pragma once

#include <string>

/// Numbers as decimal text, independent of the locale, never with the sign of a negative zero. The one place
/// where this project writes a number for people; files with all digits use append_number of text.h.
namespace stackabilization {

/// Writes the shortest text that reads back as the same double: 0.1, 1e+300.
std::string shortest_text(double value);

/// Writes the shorter of fixed and scientific notation with at most `digits` >= 1 significant digits:
/// 0.412, 1.2e-07.
std::string significant_text(double value, int digits);

/// Writes `decimals` >= 0 digits after the point, halves away from zero: 0.5000, -12.3.
std::string fixed_text(double value, int decimals);

/// Writes one digit before and `decimals` >= 0 digits after the point: 3.1e-16.
std::string scientific_text(double value, int decimals);

}  // namespace stackabilization
