#pragma once

/// Tolerances of the search for designs and of their refinement.
namespace stackabilization::tolerance {

/// A search identifies two designs when their controls differ by less than this, fraction of the diagonal. It
/// is far above the rounding of edits in another order, and far below any step.
inline constexpr double same_design = 1e-6;

/// Largest amount by which S of a refined design may exceed its target, when its distortion depends on it.
inline constexpr double target = 1e-7;

/// Relative accuracy at which magnitudes of edits, and the distortion that they cause, count as converged.
inline constexpr double magnitude = 1e-6;

}  // namespace stackabilization::tolerance
