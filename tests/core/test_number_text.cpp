#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

#include "stackabilization/core/number_text.h"
#include "support/catch.h"

using namespace stackabilization;

TEST_CASE("the shortest text of a number reads back as the same double") {
  CHECK(shortest_text(0.1) == "0.1");
  CHECK(shortest_text(1e300) == "1e+300");
  CHECK(shortest_text(-0.0) == "0");
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> exponent(-300, 300), mantissa(-10, 10);
  for (int i = 0; i < 2000; ++i) {
    const double value = mantissa(random) * std::pow(10, exponent(random));
    REQUIRE(std::strtod(shortest_text(value).c_str(), nullptr) == value);
  }
}

TEST_CASE("significant digits are as many as asked for, without trailing zeros") {
  CHECK(significant_text(2.0 / 3, 3) == "0.667");
  CHECK(significant_text(0.5, 4) == "0.5");
  CHECK(significant_text(123456, 3) == "1.23e+05");
  CHECK(significant_text(-0.0, 5) == "0");
}

TEST_CASE("fixed digits are rounded half away from zero and never show a negative zero") {
  CHECK(fixed_text(0.0625, 3) == "0.063");
  CHECK(fixed_text(-0.0625, 3) == "-0.063");
  CHECK(fixed_text(-1e-9, 4) == "0.0000");
  CHECK(fixed_text(12.25, 1) == "12.3");
  CHECK(fixed_text(2, 0) == "2");
  // Beyond 2^53 a double has no digits after the point, and 10^308 has all of its own before it.
  CHECK(fixed_text(std::ldexp(1, 60), 3) == "1152921504606846976.000");
  CHECK(fixed_text(std::numeric_limits<double>::max(), 2).size() == 309 + 3);
}

TEST_CASE("fixed text is off by half a unit of its last digit at most") {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> value(-1000, 1000);
  for (int i = 0; i < 2000; ++i) {
    const double x = value(random);
    for (const int decimals : {0, 1, 3, 6})
      REQUIRE(std::abs(std::strtod(fixed_text(x, decimals).c_str(), nullptr) - x) <=
              0.5 * std::pow(10, -decimals) * (1 + 1e-6));
  }
}

TEST_CASE("scientific text has one digit before the point") {
  CHECK(scientific_text(3.14159e-16, 1) == "3.1e-16");
  CHECK(scientific_text(0, 2) == "0.00e+00");
}
