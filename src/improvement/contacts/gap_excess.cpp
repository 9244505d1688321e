#include "improvement/contacts/gap_excess.h"

#include <algorithm>

namespace stackabilization::detail {

GapExcess::GapExcess(const RequirementChecker& checker, const Direction& direction)
    : checker_(checker),
      blocks_(checker.space().rest().shape, direction, checker.requirements().measure.semantics, 1) {
  const double allowed = allowed_separation(checker.rest_shape().measure(direction));
  for (const BlockPair& pair : blocks_.pairs_above(checker.space().rest().shape, allowed))
    overlaps_at_rest_[{pair.upper, pair.lower}] = pair.overlap;
}

double GapExcess::allowed_separation(const Stackability& measured) const {
  return (1 - checker_.required_stackability(measured)) / measured.loss_per_length() -
         checker_.requirements().measure.clearance;
}

SummedExcess GapExcess::of(const Shape& shape, const Stackability& measured) const {
  const double allowed = allowed_separation(measured);
  SummedExcess sum;
  for (const BlockPair& pair : blocks_.pairs_above(shape, allowed)) {
    const auto rest = overlaps_at_rest_.find({pair.upper, pair.lower});
    const bool known = rest != overlaps_at_rest_.end() && rest->second > 0;
    sum.equal += pair.f - allowed;
    sum.by_overlap += (pair.f - allowed) * (known ? std::min(1.0, pair.overlap / rest->second) : 1);
  }
  return {sum.equal / measured.extent, sum.by_overlap / measured.extent};
}

}  // namespace stackabilization::detail
