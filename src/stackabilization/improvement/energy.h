#pragma once

#include <vector>

#include "stackabilization/improvement/design.h"
#include "stackabilization/stacking/stackability.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// D(M0, M) by its terms (paper, Eq. 6 to 10), each without unit.
struct Distortion {
  double volume = 0;     ///< D_vol, Eq. 7: changes of the primitives' volumes
  double proximity = 0;  ///< D_prox, Eq. 8: changes of distances between primitives; 0 for fewer than two
  double box = 0;        ///< D_BB, Eq. 9: changes of the three sides of the box
  double symmetry = 0;   ///< D_symm, Eq. 10, over the diagonal: 0 without symmetric pairs

  /// Their mean, Eq. 6.
  double total() const { return (volume + proximity + box + symmetry) / 4; }
};

/// E(M), Eq. 5.
struct Energy {
  Distortion distortion;
  double gain = 0;   ///< Delta S = S(M) - S(M0)
  double value = 0;  ///< alpha D - (1 - alpha) Delta S
};

/// Distance d of Eq. 8 between two primitives: the least distance between their axes, model units. The axis
/// of a generalized cylinder is its curve (closed where it is), that of a cuboid the segment between the
/// centres of the two faces that are farthest apart (ties by face). It does not vanish for parts that touch,
/// unless their axes cross.
double axis_distance(const Primitive& a, const Primitive& b);

/// Measures designs against one rest. Const, safe from any number of threads.
class EnergyMeter {
 public:
  /// `boxes`: which box D_BB looks at, the minimal oriented one (its sides in descending order) or the
  /// file's. `alpha` in [0, 1]. Throws UsageError for an alpha out of range.
  EnergyMeter(const StructuredShape& rest, BoxModel boxes, double alpha = 0.2);

  Distortion distortion(const Design& design) const;
  Energy energy(const Design& design, double gain) const;
  double alpha() const { return alpha_; }

 private:
  struct Rest;
  double alpha_;
  std::shared_ptr<const Rest> rest_;
};

}  // namespace stackabilization
