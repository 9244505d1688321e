#include "stackabilization/core/rational.h"

#include <cmath>
#include <limits>
#include <utility>

#include "core/rational_number.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

mpz_class parse_integer(const std::string& text) {
  mpz_class integer;
  if (text.empty() || integer.set_str(text, 10) != 0)
    throw UsageError("'" + text + "' is not a decimal integer");
  return integer;
}

}  // namespace

Rational::Rational() : number_(std::make_unique<Number>()) {}

Rational::Rational(Number number) : number_(std::make_unique<Number>(std::move(number))) {}

Rational::Rational(double value) : Rational() {
  if (!std::isfinite(value)) throw UsageError("a rational number needs a finite value");
  number_->value = value;
}

Rational::Rational(const std::string& numerator, const std::string& denominator) : Rational() {
  const mpz_class bottom = parse_integer(denominator);
  if (bottom == 0) throw UsageError("a rational number cannot have denominator 0");
  number_->value = mpq_class(parse_integer(numerator), bottom);
  number_->value.canonicalize();
}

Rational::Rational(const Rational& other) : number_(std::make_unique<Number>(*other.number_)) {}

Rational::Rational(Rational&& other) noexcept : number_(std::move(other.number_)) {
  other.number_ = std::make_unique<Number>();
}

Rational& Rational::operator=(const Rational& other) {
  number_->value = other.number_->value;
  return *this;
}

Rational& Rational::operator=(Rational&& other) noexcept {
  std::swap(number_, other.number_);
  return *this;
}

Rational::~Rational() = default;

std::string Rational::numerator() const {
  return number_->value.get_num().get_str();
}

std::string Rational::denominator() const {
  return number_->value.get_den().get_str();
}

double Rational::to_double() const {
  // GMP truncates towards zero; the nearest double is that one or its neighbour away from zero.
  const mpq_class& exact = number_->value;
  const double inner = exact.get_d();
  const double outer = std::nextafter(inner, sgn(exact) < 0 ? -std::numeric_limits<double>::infinity()
                                                            : std::numeric_limits<double>::infinity());
  if (!std::isfinite(inner) || !std::isfinite(outer)) return inner;
  const mpq_class to_inner = abs(exact - mpq_class(inner)), to_outer = abs(mpq_class(outer) - exact);
  if (to_inner == to_outer) {
    int exponent = 0;
    const auto significand = static_cast<std::int64_t>(std::ldexp(std::frexp(inner, &exponent), 53));
    return significand % 2 == 0 ? inner : outer;
  }
  return to_inner < to_outer ? inner : outer;
}

Rational operator+(const Rational& a, const Rational& b) {
  Rational sum;
  sum.number_->value = a.number_->value + b.number_->value;
  return sum;
}

Rational operator-(const Rational& a, const Rational& b) {
  Rational difference;
  difference.number_->value = a.number_->value - b.number_->value;
  return difference;
}

Rational operator*(const Rational& a, const Rational& b) {
  Rational product;
  product.number_->value = a.number_->value * b.number_->value;
  return product;
}

Rational operator/(const Rational& a, const Rational& b) {
  if (sgn(b.number_->value) == 0) throw UsageError("division of a rational number by zero");
  Rational quotient;
  quotient.number_->value = a.number_->value / b.number_->value;
  return quotient;
}

std::strong_ordering operator<=>(const Rational& a, const Rational& b) {
  return cmp(a.number_->value, b.number_->value) <=> 0;
}

bool operator==(const Rational& a, const Rational& b) {
  return a.number_->value == b.number_->value;
}

}  // namespace stackabilization
