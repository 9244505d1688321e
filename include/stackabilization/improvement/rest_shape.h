#pragma once

#include "stackabilization/improvement/energy.h"
#include "stackabilization/stacking/stackability.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// What a search for designs asks of the shape at rest again and again: its hull, its box, its separations
/// and what energies compare with. Computed once, shared by all steps of a run. Const, safe from any number
/// of threads.
class RestShape {
 public:
  /// `measure`: meaning of S. Throws as the constructors of StackabilitySolver and EnergyMeter.
  RestShape(const StructuredShape& rest, const StackabilityOptions& measure);

  const Shape& shape() const { return solver_.shape(); }                    ///< copy of the shape at rest
  const HullSupport& hull() const { return solver_.hull(); }                ///< convex hull of the shape
  const StackabilityOptions& options() const { return solver_.options(); }  ///< the measure given

  /// Returns S(M0, r) with clearance and play. Equals `stackability` of the shape to the bit.
  Stackability measure(const Direction& direction) const;
  /// Returns a solver that leaves out the play. Play is slow to measure and only raises f_max, so searches
  /// for directions do without it.
  const StackabilitySolver& solver_without_play() const { return without_play_; }
  /// Returns a meter of distortions from this shape, with the alpha of the paper.
  const EnergyMeter& energy_meter() const { return meter_; }

 private:
  StackabilitySolver solver_, without_play_;
  EnergyMeter meter_;
};

}  // namespace stackabilization
