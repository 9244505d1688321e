#include "stackabilization/core/units.h"

#include <cmath>
#include <cstdint>
#include <numeric>

#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

/// All units are whole numbers of these: a length is converted by a fraction, and rounded as little as can
/// be.
constexpr double steps_per_metre = 1e7;

struct Fraction {
  double numerator, denominator;
};

/// Returns the fraction, reduced, that converts lengths of `from` to lengths of `to`.
Fraction conversion(Unit from, Unit to) {
  const std::int64_t a = std::llround(metres_per_unit(from) * steps_per_metre),
                     b = std::llround(metres_per_unit(to) * steps_per_metre), common = std::gcd(a, b);
  return {static_cast<double>(a / common), static_cast<double>(b / common)};
}

Fraction checked_conversion(Unit from, Unit to) {
  if (from == Unit::unknown || to == Unit::unknown)
    throw UsageError("lengths of an unknown unit cannot be converted");
  return conversion(from, to);
}

}  // namespace

double convert_length(double length, Unit from, Unit to) {
  const Fraction by = conversion(from, to);
  return length * by.numerator / by.denominator;
}

Unit readable_unit(double length, Unit unit) {
  const auto smaller = [](Unit u) {
    if (u == Unit::metre) return Unit::centimetre;
    if (u == Unit::centimetre) return Unit::millimetre;
    return u == Unit::foot ? Unit::inch : u;
  };
  Unit read = unit;
  while (length != 0 && std::abs(convert_length(length, unit, read)) < 1 && smaller(read) != read)
    read = smaller(read);
  return read;
}

Shape in_unit(const Shape& shape, Unit unit) {
  const Fraction by = checked_conversion(shape.unit, unit);
  Shape result = shape;
  result.vertices = result.vertices * by.numerator / by.denominator;
  result.unit = unit;
  return result;
}

Copies in_unit(const Copies& copies, Unit unit) {
  const Fraction by = checked_conversion(copies.shapes.front().unit, unit);
  Copies result{{}, copies.placed};
  for (const Shape& shape : copies.shapes) result.shapes.push_back(in_unit(shape, unit));
  for (PlacedCopy& copy : result.placed) copy.translation = copy.translation * by.numerator / by.denominator;
  return result;
}

}  // namespace stackabilization
