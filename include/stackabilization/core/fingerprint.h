#pragma once

#include <Eigen/Core>
#include <bit>
#include <cstdint>
#include <string_view>

namespace stackabilization {

/// A 64-bit hash of a sequence of values, the same on every machine: FNV-1a over their bytes, lowest first.
class Fingerprint {
 public:
  /// Its eight bytes.
  void add(std::uint64_t value) {
    for (int byte = 0; byte < 8; ++byte) mix(static_cast<unsigned char>(value >> (8 * byte) & 0xff));
  }
  /// 0 and -0 are one value.
  void add(double value) { add(std::bit_cast<std::uint64_t>(value + 0.0)); }
  /// Its length, then its bytes.
  void add(std::string_view text) {
    add(static_cast<std::uint64_t>(text.size()));
    for (const char c : text) mix(static_cast<unsigned char>(c));
  }
  /// How many there are, then all of them, row by row.
  template <class Derived>
  void add_numbers(const Eigen::MatrixBase<Derived>& numbers) {
    add(static_cast<std::uint64_t>(numbers.size()));
    for (Eigen::Index row = 0; row < numbers.rows(); ++row)
      for (Eigen::Index column = 0; column < numbers.cols(); ++column)
        add(static_cast<double>(numbers(row, column)));
  }

  /// The hash of all that was added.
  std::uint64_t value() const { return hash_; }

 private:
  void mix(unsigned char byte) {
    hash_ ^= byte;
    hash_ *= 0x100000001b3;
  }

  std::uint64_t hash_ = 0xcbf29ce484222325;
};

}  // namespace stackabilization
