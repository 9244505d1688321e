#include "stackabilization/core/number_text.h"

#include <array>
#include <charconv>
#include <cmath>

namespace stackabilization {

namespace {

/// As many characters as the longest double in fixed notation has, and the digits asked for after the point.
constexpr std::size_t longest = 400;

template <class... Format>
std::string written(double value, Format... format) {
  std::array<char, longest> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value + 0.0, format...).ptr;
  return {buffer.data(), end};
}

}  // namespace

std::string shortest_text(double value) {
  return written(value);
}

std::string significant_text(double value, int digits) {
  return written(value, std::chars_format::general, digits);
}

std::string fixed_text(double value, int decimals) {
  const double unit = std::pow(10.0, decimals), scaled = std::round(value * unit);
  constexpr double whole_from = 9007199254740992;  // 2^53: larger doubles have no digits after the point
  const double rounded = std::abs(scaled) < whole_from ? scaled / unit : value;
  return written(rounded, std::chars_format::fixed, decimals);
}

std::string scientific_text(double value, int decimals) {
  return written(value, std::chars_format::scientific, decimals);
}

}  // namespace stackabilization
