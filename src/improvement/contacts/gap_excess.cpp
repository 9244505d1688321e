#include "improvement/contacts/gap_excess.h"

namespace stackabilization::detail {

GapExcess::GapExcess(const RequirementChecker& checker, const Direction& direction)
    : checker_(checker),
      blocks_(checker.space().rest().shape, direction, checker.requirements().measure.semantics, 1) {}

double GapExcess::allowed_separation(const Stackability& measured) const {
  return (1 - checker_.required_stackability(measured)) / measured.loss_per_length() -
         checker_.requirements().measure.clearance;
}

double GapExcess::of(const Shape& shape, const Stackability& measured) const {
  const double allowed = allowed_separation(measured);
  double sum = 0;
  for (const BlockPair& pair : blocks_.pairs_above(shape, allowed)) sum += pair.f - allowed;
  return sum / measured.extent;
}

}  // namespace stackabilization::detail
