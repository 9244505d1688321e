#pragma once

#include <map>
#include <utility>

#include "improvement/contacts/block_separations.h"
#include "stackabilization/improvement/requirements.h"

namespace stackabilization::detail {

/// By how much all pairs of parts that touch keep the copies of a design farther apart than the requirements
/// allow, fractions of the extent.
struct SummedExcess {
  double equal = 0;  ///< F = sum max(0, f_ij - f*) / h, f* = (1 - target) h V(M) / V(M, r) - clearance
  /// The same sum, in which a pair that stood in the way at rest counts by the portion of its overlap across
  /// r that is left (BlockPair::overlap), at most as a whole.
  double by_overlap = 0;
};

/// Summed gap excess of designs along one direction. It falls with every pair that is separated, also where
/// several pairs block at the same height and S stays; `by_overlap` also with every pair that comes nearer to
/// passing. Const, safe from any number of threads.
class GapExcess {
 public:
  /// The checker must outlive this object.
  GapExcess(const RequirementChecker& checker, const Direction& direction);

  /// Returns f* for a design with these measures, model units.
  double allowed_separation(const Stackability& measured) const;
  /// Returns the excess of a design with these measures.
  SummedExcess of(const Shape& shape, const Stackability& measured) const;

 private:
  const RequirementChecker& checker_;
  BlockSeparations blocks_;
  std::map<std::pair<int, int>, double> overlaps_at_rest_;  ///< by upper and lower block
};

}  // namespace stackabilization::detail
