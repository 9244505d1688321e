#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>

namespace stackabilization {

/// Loads the number at `bytes` in the given byte order. No alignment is required.
template <class Number>
Number load(const char* bytes, std::endian order) {
  std::array<char, sizeof(Number)> buffer;
  std::memcpy(buffer.data(), bytes, sizeof(Number));
  if (order != std::endian::native) std::reverse(buffer.begin(), buffer.end());
  return std::bit_cast<Number>(buffer);
}

template <class Number>
void append_little(std::string& text, Number value) {
  auto buffer = std::bit_cast<std::array<char, sizeof(Number)>>(value);
  if (std::endian::native != std::endian::little) std::reverse(buffer.begin(), buffer.end());
  text.append(buffer.data(), buffer.size());
}

}  // namespace stackabilization
