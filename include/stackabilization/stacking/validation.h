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

namespace stackabilization {

/// A way to sample the envelopes that is handed in from outside, e.g. a graphics card's depth buffer.
struct HeightFieldMaker {
  std::string name;  ///< how rows of the report call it
  /// Samples the window given; may throw.
  std::function<HeightField(const Shape&, const Direction&, const Window&)> make;
  double precision = tolerance::relative;  ///< of its heights, as a fraction of the extent h
  /// Why it may exceed the exact value beyond its precision, as a note for such rows. Empty: it may not.
  std::string excess = {};
};

/// Which checks `validate_translation` makes, and how finely.
struct ValidationOptions {
  std::vector<int> resolutions = {64, 128, 256, 512};  ///< samples along the longer side, ascending
  std::vector<HeightFieldMaker> further_rasters;       ///< run after the rays and the scan conversion
  /// Collisions are tested this far above and below f_max, as a fraction of h, or of the width where h is 0.
  double collision_margin = tolerance::collision_margin;
  int bisection_steps = 64;                      ///< lifts tried on the way down from the top
  Eigen::Index max_collision_triangles = 50000;  ///< above this, collision tests are skipped
  std::int64_t max_ray_hits = 5'000'000;         ///< most triangles that rays of a check meet; skipped above
};

/// What a check says about the exact value.
enum class Verdict {
  agrees,           ///< equal to the exact value, or the answer that the exact value demands
  within_sampling,  ///< off the exact value as this sampling may be: below it, or above with a note why
  skipped,          ///< the check does not apply to this shape; the note says why
  disagrees,        ///< the check contradicts the exact value
};

/// One check of f_max.
struct ValidationRow {
  std::string name;                    ///< method and resolution
  std::optional<double> value;         ///< the check's own f_max, or the lift that it tested, model units
  std::optional<double> error;         ///< (value - exact) / h, for checks that have a value of their own
  double seconds = 0;                  ///< wall time of the check
  Verdict verdict = Verdict::skipped;  ///< what it says about the exact value
  std::string note;                    ///< reason, explanation; may be empty
};

/// All checks of one shape along one direction.
struct ValidationReport {
  Eigen::Vector3d direction;        ///< r as given
  double extent = 0;                ///< h(M, r), model units
  Separation solid, closed;         ///< the exact answers that the rows are held against
  std::vector<ValidationRow> rows;  ///< in the order in which they were made
  bool passed = false;              ///< no row disagrees
};

/// Holds the exact f_max against methods that share no code with it:
/// the height fields by rays and by scan conversion, which must not exceed it and close in on it, and those
/// handed in, which must not exceed it either unless they say why they may; rays zoomed in on the witness;
/// collision tests just above and just below it; a search by collision tests from the top; for small closed
/// solids the Minkowski sum, which must be the very same rational number.
///
/// Sampled values are held against the solid f_max; one between it and the closed f_max comes from a sample
/// on a wall along r and is accepted with a note. Where winding numbers do not tell the interior (open
/// shapes, parts inside out among others, surfaces that cancel each other: `InteriorDefect`) only "free above
/// the closed f_max" is demanded of collisions, and contact at it where triangles with area attain it. Throws
/// InputError as `validate` does, UsageError for an empty or unsorted list of resolutions or a margin that is
/// not positive.
ValidationReport validate_translation(const Shape& shape, const Direction& direction,
                                      const ValidationOptions& options = {});

/// "agrees", "within sampling", "skipped", "DISAGREES".
std::string to_string(Verdict verdict);

/// The report as a text table: one line per row, a heading, and a last line with the overall verdict.
std::string table(const ValidationReport& report);

}  // namespace stackabilization
