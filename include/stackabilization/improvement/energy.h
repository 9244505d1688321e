#pragma once

#include <Eigen/Core>
#include <memory>

#include "stackabilization/deformation/deformation_model.h"
#include "stackabilization/stacking/stackability.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Distortion D(M0, M) by its terms (paper, Eq. 6 to 10). Each term is dimensionless, >= 0, and exactly 0 at
/// rest.
struct Distortion {
  double volume = 0;  ///< D_vol, Eq. 7: changes of the volumes of the primitives
  /// D_prox, Eq. 8: changes of the distances between primitives; 0 for fewer than two primitives.
  double proximity = 0;
  double box = 0;  ///< D_BB, Eq. 9: changes of the extents along the three main axes
  /// D_symm, Eq. 10: violation of symmetries, over the diagonal; 0 without symmetric pairs.
  double symmetry = 0;

  /// Returns D, Eq. 6: the mean of the four terms.
  double total() const { return (volume + proximity + box + symmetry) / 4; }
};

/// Signed summands of the terms of D. D_vol, D_prox and D_BB are sums of absolute values, with a kink
/// wherever a summand vanishes. The summands themselves are smooth, so an optimiser can treat the kinks
/// explicitly.
struct DistortionChanges {
  Eigen::VectorXd volume;     ///< one summand per part, Eq. 7
  Eigen::VectorXd proximity;  ///< one per pair of parts i < j, Eq. 8; ordered by j, then i
  Eigen::VectorXd box;        ///< one per main axis, Eq. 9
  double symmetry = 0;        ///< D_symm, >= 0

  Distortion distortion() const;  ///< sums of absolute values, Eq. 7 to 10
};

/// Energy E(M), Eq. 5.
struct Energy {
  Distortion distortion;  ///< D by its terms
  double gain = 0;        ///< Delta S = S(M) - S(M0)
  double value = 0;       ///< E = alpha D - (1 - alpha) Delta S
};

/// Returns the distance d of Eq. 8 between two primitives: the least distance between their axes, model
/// units. The axis of a generalized cylinder is its curve (closed if the cylinder is closed). The axis of a
/// cuboid is the segment between the centres of the two opposite faces that are farthest apart (ties within
/// tolerance::relative: the first pair). Touching parts have d > 0 unless their axes cross.
double axis_distance(const Primitive& a, const Primitive& b);

/// Measures distortion and energy of designs against one shape at rest. Const, safe from any number of
/// threads.
///
/// D varies continuously with the design, because every choice that could jump is made at rest: the pair of
/// faces between which the axis of a cuboid runs, the corresponding control points of symmetric pairs, and
/// the three main axes of Eq. 9. The main axes are those of the box of the shape at rest, and extents of
/// designs are measured along them. V(M) of a design is at most the product of these extents, so D counts
/// every growth of V(M).
///
/// Eq. 10 counts only the part of a symmetry violation that exceeds the violation at rest (which is rounding
/// for results of `analyse_structure`). Where the denominator of Eq. 8 or 7 vanishes at rest (all axes cross,
/// or no primitive has a volume) the diagonal, or its cube, takes its place.
class EnergyMeter {
 public:
  /// `boxes`: which box gives the main axes of Eq. 9, the minimal oriented one or the file's. `alpha`: weight
  /// of D in Eq. 5, in [0, 1]. Throws UsageError for an alpha out of range, InputError when `rest` is
  /// invalid.
  EnergyMeter(const StructuredShape& rest, BoxModel boxes, double alpha = 0.2);
  /// `main_axes`: the main axes of Eq. 9 as orthonormal columns, those of the box of the shape. Throws as the
  /// other constructor.
  EnergyMeter(const StructuredShape& rest, const Eigen::Matrix3d& main_axes, double alpha = 0.2);

  /// Returns a meter of the same shape at rest with another weight. Throws UsageError for an alpha out of
  /// range.
  EnergyMeter with_alpha(double alpha) const;

  /// Returns D by its terms. Throws UsageError unless `design` has the vertices and primitives of the shape
  /// at rest.
  Distortion distortion(const Design& design) const;
  /// Returns the signed summands of D. Throws as `distortion`.
  DistortionChanges changes(const Design& design) const;
  /// Returns E for a gain Delta S that the caller has measured. Throws as `distortion`.
  Energy energy(const Design& design, double gain) const;
  double alpha() const { return alpha_; }  ///< weight of D in Eq. 5

 private:
  struct Rest;
  double alpha_;
  std::shared_ptr<const Rest> rest_;
};

}  // namespace stackabilization
