#pragma once

#include <string>

/// Numbers as decimal text, independent of the locale, without the sign of a negative zero. All numbers for
/// people use these functions; files with all digits use append_number of text.h.
namespace stackabilization {

/// Returns the shortest text that reads back as the same double: 0.1, 1e+300.
std::string shortest_text(double value);

/// Returns the shorter of fixed and scientific notation with at most `digits` >= 1 significant digits: 0.412,
/// 1.2e-07.
std::string significant_text(double value, int digits);

/// Returns a text with `decimals` >= 0 digits after the point; halves are rounded away from zero: 0.5000,
/// -12.3.
std::string fixed_text(double value, int decimals);

/// Returns a text with one digit before and `decimals` >= 0 digits after the point: 3.1e-16.
std::string scientific_text(double value, int decimals);

}  // namespace stackabilization
