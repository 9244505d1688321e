#pragma once

#include <compare>
#include <memory>
#include <string>

namespace stackabilization {

/// An exact rational number with value semantics, in lowest terms. As thread-safe as an int.
class Rational {
 public:
  Rational();  ///< zero
  /// Represents the double exactly. Throws UsageError unless finite.
  explicit Rational(double value);
  /// Creates numerator / denominator from decimal integers. Throws UsageError for a malformed number or a
  /// zero denominator.
  Rational(const std::string& numerator, const std::string& denominator);
  Rational(const Rational& other);
  Rational(Rational&& other) noexcept;
  Rational& operator=(const Rational& other);
  Rational& operator=(Rational&& other) noexcept;
  ~Rational();

  std::string numerator() const;    ///< decimal, with sign
  std::string denominator() const;  ///< decimal, positive
  /// Returns the nearest double, ties to even.
  double to_double() const;

  /// The GMP number, for code that computes with GMP: see core/rational_number.h.
  struct Number;
  /// Takes over a GMP rational.
  explicit Rational(Number number);
  /// Returns the GMP number, for sources that include core/rational_number.h.
  const Number& number() const { return *number_; }

  /// Adds exactly. All arithmetic and all comparisons of this class are exact.
  friend Rational operator+(const Rational& a, const Rational& b);
  /// Subtracts exactly.
  friend Rational operator-(const Rational& a, const Rational& b);
  /// Multiplies exactly.
  friend Rational operator*(const Rational& a, const Rational& b);
  /// Divides exactly. Throws UsageError when b is zero.
  friend Rational operator/(const Rational& a, const Rational& b);
  /// Compares values exactly.
  friend std::strong_ordering operator<=>(const Rational& a, const Rational& b);
  /// Returns whether the values are equal, exactly.
  friend bool operator==(const Rational& a, const Rational& b);

 private:
  std::unique_ptr<Number> number_;
};

}  // namespace stackabilization
