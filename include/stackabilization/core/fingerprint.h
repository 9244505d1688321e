#pragma once

#include <Eigen/Core>
#include <bit>
#include <cstdint>
#include <string_view>

namespace stackabilization {

/// A 64-bit hash of a sequence of values: FNV-1a over their bytes, lowest byte first. It is the same on every
/// machine.
class Fingerprint {
 public:
  /// Adds the eight bytes of an integer.
  void add(std::uint64_t value) {
    for (int byte = 0; byte < 8; ++byte) mix(static_cast<unsigned char>(value >> (8 * byte) & 0xff));
  }
  /// Adds a double. 0 and -0 are equal.
  void add(double value) { add(std::bit_cast<std::uint64_t>(value + 0.0)); }
  /// Adds the length of a text, then its bytes.
  void add(std::string_view text) {
    add(static_cast<std::uint64_t>(text.size()));
    for (const char c : text) mix(static_cast<unsigned char>(c));
  }
  /// Adds the number of entries of a matrix, then all entries, row by row.
  template <class Derived>
  void add_numbers(const Eigen::MatrixBase<Derived>& numbers) {
    add(static_cast<std::uint64_t>(numbers.size()));
    for (Eigen::Index row = 0; row < numbers.rows(); ++row)
      for (Eigen::Index column = 0; column < numbers.cols(); ++column)
        add(static_cast<double>(numbers(row, column)));
  }

  /// Returns the hash of all added values.
  std::uint64_t value() const { return hash_; }

 private:
  void mix(unsigned char byte) {
    hash_ ^= byte;
    hash_ *= 0x100000001b3;
  }

  std::uint64_t hash_ = 0xcbf29ce484222325;
};

}  // namespace stackabilization
