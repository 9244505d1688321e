#pragma once

#include "stackabilization/core/copies.h"
#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Returns a length of `from` in `to`, rounded. A length of an unknown unit counts as metres.
double convert_length(double length, Unit from, Unit to);

/// Returns the unit in which a person reads a length: `unit`, or the largest smaller one of metre, centimetre
/// and millimetre, or of foot and inch, in which the length is at least 1, or the smallest of them. A
/// length of 0 is read in `unit`.
Unit readable_unit(double length, Unit unit);

/// Returns the shape with its coordinates in `unit`, rounded; unchanged where it is in that unit.
/// Throws UsageError unless both units are known.
Shape in_unit(const Shape& shape, Unit unit);
/// The same for copies, their places included.
Copies in_unit(const Copies& copies, Unit unit);

}  // namespace stackabilization
