#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/envelope/height_field.h"
#include "stackabilization/envelope/separation.h"
#include "stackabilization/stacking/tolerances.h"

namespace stackabilization {

/// A sampling method for envelopes that the caller provides, such as the depth buffer of a graphics card.
struct HeightFieldMaker {
  std::string name;  ///< name in the rows of the report
  /// Samples the given window; may throw.
  std::function<HeightField(const Shape&, const Direction&, const Window&)> make;
  /// Accuracy of its heights, fraction of the extent h.
  double precision = tolerance::relative;
  /// Reason why its values may exceed the exact value beyond the precision, as a note for such rows. Empty:
  /// they may not.
  std::string excess = {};
};

/// Options of `validate_translation`.
struct ValidationOptions {
  /// Numbers of samples along the longer side, ascending.
  std::vector<int> resolutions = {64, 128, 256, 512};
  /// Sampling methods that run after the rays and the scan conversion.
  std::vector<HeightFieldMaker> further_rasters;
  /// Distance above and below f_max at which collisions are tested, fraction of h, or of the width when h is
  /// 0.
  double collision_margin = tolerance::collision_margin;
  int bisection_steps = 64;  ///< number of lifts that the search from the top tests
  /// Collision tests are skipped for shapes with more triangles.
  Eigen::Index max_collision_triangles = 50000;
  /// A check by rays is skipped when its rays meet more triangles.
  std::int64_t max_ray_hits = 5'000'000;
};

/// Result of the comparison of a check with the exact value.
enum class Verdict {
  /// The check gives the exact value, or the outcome that the exact value implies.
  agrees,
  /// The check differs from the exact value within the error of its sampling: it is below, or above with a
  /// note.
  within_sampling,
  /// The check does not apply to this shape; the note gives the reason.
  skipped,
  /// The check contradicts the exact value.
  disagrees,
};

/// One check of f_max.
struct ValidationRow {
  std::string name;  ///< method and resolution
  /// f_max according to the check, or the tested lift, model units.
  std::optional<double> value;
  /// (value - exact) / h, for checks with a value of their own.
  std::optional<double> error;
  double seconds = 0;                  ///< wall time of the check
  Verdict verdict = Verdict::skipped;  ///< comparison with the exact value
  std::string note;                    ///< reason, explanation; may be empty
};

/// All checks of one shape along one direction.
struct ValidationReport {
  Eigen::Vector3d direction;        ///< r as given
  double extent = 0;                ///< h(M, r), model units
  Separation solid, closed;         ///< exact values for comparison, in both semantics
  std::vector<ValidationRow> rows;  ///< checks in the order of execution
  bool passed = false;              ///< whether no check disagrees
};

/// Compares the exact f_max with methods that share no code with it:
///
/// * the height fields by rays and by scan conversion, which must not exceed it and must converge to it;
/// * the height fields of the caller, which must not exceed it unless `excess` gives a reason;
/// * rays at high resolution around the witness;
/// * collision tests just above, at and just below it (collision_probes.h);
/// * a search by collision tests from the top;
/// * for small closed solids, the Minkowski sum, which must give the identical rational number.
///
/// Sampled values are compared with the solid f_max. A value between it and the closed f_max comes from a
/// sample on a wall along r, and is accepted with a note. When winding numbers do not define the interior
/// (`InteriorDefect`: open shapes, single parts inside out, surfaces that cancel each other), the collision
/// tests require only that lifts above the closed f_max are free, and that there is contact at it when
/// triangles with area attain it. Throws InputError as `validate` does. Throws UsageError for an empty or
/// unsorted list of resolutions and for a margin that is not positive.
ValidationReport validate_translation(const Shape& shape, const Direction& direction,
                                      const ValidationOptions& options = {});

/// Returns "agrees", "within sampling", "skipped" or "DISAGREES".
std::string to_string(Verdict verdict);

/// Returns the report as a text table: a heading, one line per row, and a last line with the overall verdict.
std::string table(const ValidationReport& report);

}  // namespace stackabilization
