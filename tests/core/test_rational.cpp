#include <cmath>
#include <limits>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/rational.h"
#include "support/catch.h"

using namespace stackabilization;

TEST_CASE("a rational keeps a double exactly and comes back in lowest terms") {
  CHECK(Rational(0.75).numerator() == "3");
  CHECK(Rational(0.75).denominator() == "4");
  CHECK(Rational(-0.1).to_double() == -0.1);
  CHECK(Rational("6", "-4") == Rational(-1.5));
  CHECK(Rational("6", "-4").denominator() == "2");
}

TEST_CASE("rational arithmetic is exact where doubles are not") {
  const Rational sum = Rational(0.1) + Rational(0.2);
  CHECK(sum != Rational(0.3));
  CHECK(sum - Rational(0.2) == Rational(0.1));
  CHECK(Rational("1", "3") * Rational(3.0) == Rational(1.0));
  CHECK(Rational(1.0) / Rational(3.0) == Rational("1", "3"));
  CHECK(Rational("1", "3") < Rational("1000001", "3000000"));
}

TEST_CASE("to_double rounds to nearest, ties to even") {
  const double next = std::nextafter(1.0, 2.0), gap = next - 1;
  const Rational half = Rational(gap) / Rational(2.0);
  CHECK((Rational(1.0) + half).to_double() == 1.0);
  CHECK((Rational(next) + half).to_double() == std::nextafter(next, 2.0));
  CHECK((Rational(1.0) + half + Rational(1e-40)).to_double() == next);
  CHECK((Rational(-1.0) - half - Rational(1e-40)).to_double() == -next);
  CHECK(Rational("1", "3").to_double() == 1.0 / 3.0);
}

TEST_CASE("a rational refuses what is not a number") {
  CHECK_THROWS_AS(Rational(std::numeric_limits<double>::infinity()), UsageError);
  CHECK_THROWS_AS(Rational("1", "0"), UsageError);
  CHECK_THROWS_AS(Rational("1.5", "1"), UsageError);
  CHECK_THROWS_AS(Rational(1.0) / Rational(), UsageError);
}

TEST_CASE("a moved-from rational is still a number") {
  Rational a(2.0);
  const Rational b = std::move(a);
  CHECK(b == Rational(2.0));
  CHECK(a == Rational(0.0));
}
