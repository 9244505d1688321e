#pragma once

#include <Eigen/Core>
#include <memory>

#include "stackabilization/improvement/design.h"
#include "stackabilization/stacking/stackability.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// D(M0, M) by its terms (paper, Eq. 6 to 10), each without unit, at least 0, and 0 at rest to the bit.
struct Distortion {
  double volume = 0;     ///< D_vol, Eq. 7: changes of the primitives' volumes
  double proximity = 0;  ///< D_prox, Eq. 8: changes of distances between primitives; 0 for fewer than two
  double box = 0;        ///< D_BB, Eq. 9: changes of the extents along the three main axes
  double symmetry = 0;   ///< D_symm, Eq. 10, over the diagonal: 0 without symmetric pairs

  /// Their mean, Eq. 6.
  double total() const { return (volume + proximity + box + symmetry) / 4; }
};

/// What the terms of D add up, with signs: each term is the sum of the magnitudes, which has a kink wherever
/// one of them vanishes. They themselves are smooth, and an optimiser can be told so.
struct DistortionChanges {
  Eigen::VectorXd volume;     ///< per part
  Eigen::VectorXd proximity;  ///< per pair of parts i < j, by j, then i
  Eigen::VectorXd box;        ///< per main axis
  double symmetry = 0;        ///< D_symm

  Distortion distortion() const;  ///< the sizes of these, Eq. 7 to 10 (their mean is D)
};

/// E(M), Eq. 5.
struct Energy {
  Distortion distortion;  ///< D and its terms
  double gain = 0;        ///< Delta S = S(M) - S(M0)
  double value = 0;       ///< alpha D - (1 - alpha) Delta S
};

/// Distance d of Eq. 8 between two primitives: the least distance between their axes, model units. The axis
/// of a generalized cylinder is its curve (closed where it is), that of a cuboid the segment between the
/// centres of the two opposite faces that are farthest apart (the first such pair, where others are as far
/// apart to tolerance::relative). It does not vanish for parts that touch, unless their axes cross.
double axis_distance(const Primitive& a, const Primitive& b);

/// Measures designs against one rest. Const, safe from any number of threads.
///
/// So that D varies continuously with a design, what could jump is decided at rest: which faces the axis of a
/// cuboid runs between; which control points of a symmetric pair correspond; and the three main axes of
/// Eq. 9. Those are the axes of the box of the shape at rest, and extents of designs are measured along them.
/// A design has no box larger than their product, so that a larger V(M) is always paid for.
///
/// Where the primitives of the structure miss a symmetry already at rest, only what they miss it by more
/// counts in Eq. 10 (nothing that `analyse_structure` makes does, beyond rounding). Where all axes cross at
/// rest, or no primitive has a volume, Eq. 8 and 7 would divide by zero: the diagonal, or its cube, stands
/// in.
class EnergyMeter {
 public:
  /// `boxes`: whose axes Eq. 9 looks along, the minimal oriented one's or the file's. `alpha` in [0, 1].
  /// Throws UsageError for an alpha out of range, InputError when `rest` is invalid.
  EnergyMeter(const StructuredShape& rest, BoxModel boxes, double alpha = 0.2);

  /// Throws UsageError when `design` does not have the vertices and primitives of the rest.
  Distortion distortion(const Design& design) const;
  /// What `distortion` adds up. Throws as that.
  DistortionChanges changes(const Design& design) const;
  /// E for a gain Delta S that was measured elsewhere. Throws as `distortion`.
  Energy energy(const Design& design, double gain) const;
  double alpha() const { return alpha_; }  ///< weight of D in Eq. 5

 private:
  struct Rest;
  double alpha_;
  std::shared_ptr<const Rest> rest_;
};

}  // namespace stackabilization
