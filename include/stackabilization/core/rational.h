#pragma once

#include <compare>
#include <memory>
#include <string>

namespace stackabilization {

/// An exact rational number with value semantics, in lowest terms. Thread-safe like an int.
class Rational {
 public:
  Rational();  ///< zero
  /// Exactly this double. Throws UsageError unless finite.
  explicit Rational(double value);
  /// numerator / denominator, decimal integers. Throws UsageError on a malformed number or a zero
  /// denominator.
  Rational(const std::string& numerator, const std::string& denominator);
  Rational(const Rational& other);
  Rational(Rational&& other) noexcept;
  Rational& operator=(const Rational& other);
  Rational& operator=(Rational&& other) noexcept;
  ~Rational();

  std::string numerator() const;    ///< decimal, with sign
  std::string denominator() const;  ///< decimal, positive
  /// Nearest double, ties to even.
  double to_double() const;

  /// The number behind it, for code that computes with GMP: see core/rational_number.h.
  struct Number;
  /// Takes over a GMP rational.
  explicit Rational(Number number);
  /// For sources that include core/rational_number.h.
  const Number& number() const { return *number_; }

  /// Exact, as all arithmetic and comparisons here.
  friend Rational operator+(const Rational& a, const Rational& b);
  /// Exact.
  friend Rational operator-(const Rational& a, const Rational& b);
  /// Exact.
  friend Rational operator*(const Rational& a, const Rational& b);
  /// Throws UsageError when b is zero.
  friend Rational operator/(const Rational& a, const Rational& b);
  /// By value; exact.
  friend std::strong_ordering operator<=>(const Rational& a, const Rational& b);
  /// Equal values; exact.
  friend bool operator==(const Rational& a, const Rational& b);

 private:
  std::unique_ptr<Number> number_;
};

}  // namespace stackabilization
