#pragma once

#include "improvement/contacts/block_separations.h"
#include "stackabilization/improvement/requirements.h"

namespace stackabilization::detail {

/// Summed gap excess of designs along one direction: by how much all pairs of parts that touch keep the
/// copies farther apart than the requirements allow,
///
///     F = sum max(0, f_ij - f*) / h,   f* = (1 - target) h V(M) / V(M, r) - clearance
///
/// F falls with every pair that is separated, also where several pairs block at the same height and S stays.
/// Const, safe from any number of threads.
class GapExcess {
 public:
  /// The checker must outlive this object.
  GapExcess(const RequirementChecker& checker, const Direction& direction);

  /// Returns f* for a design with these measures, model units.
  double allowed_separation(const Stackability& measured) const;
  /// Returns F of a design with these measures.
  double of(const Shape& shape, const Stackability& measured) const;

 private:
  const RequirementChecker& checker_;
  BlockSeparations blocks_;
};

}  // namespace stackabilization::detail
