#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "stackabilization/deformation/deformation_model.h"
#include "stackabilization/improvement/checks.h"
#include "stackabilization/improvement/quality.h"
#include "stackabilization/improvement/rest_shape.h"
#include "stackabilization/stacking/stackability.h"

namespace stackabilization {

/// Number of copies that must fit into a length along r: h + (copies - 1) f_max <= length.
struct StackLengthLimit {
  int copies = 2;     ///< number of copies, >= 2
  double length = 0;  ///< length along r, model units, > 0
};

/// Requirements of a solution. A design that violates one of them is no solution.
struct Requirements {
  double target = 0;  ///< S(M, r) to be reached, < 1
  /// Replaces the target, which is then used in reports only. The S that a length needs depends on the boxes,
  /// and they change with the design.
  std::optional<StackLengthLimit> length_limit;
  /// Meaning of S in all measurements, with the air that copies keep between them.
  StackabilityOptions measure;
  bool keep_height = true;      ///< h(M, r) = h(M0, r), within tolerance::relative of it
  std::vector<int> kept_parts;  ///< parts that must not change
  /// Only these parts and parts symmetric to them may change. Empty: all parts may.
  std::vector<int> editable_parts;
  /// Least allowed ratio of a size of a part to its size at rest (proportions.h); the inverse is the largest
  /// one. In [0, 1]; 0 allows everything.
  double min_size_ratio = 0.4;
  std::optional<double> box_tolerance;  ///< largest relative change of each side of the file's box
  /// Least thickness, model units. Places that are thinner at rest may stay as thin as they are.
  std::optional<double> min_thickness;
  /// Least draft angle: between r and every surface on which copies touch, degrees, in [0, 90].
  std::optional<double> min_draft_degrees;
  std::optional<int> standing_copies;  ///< number of copies whose stack must stand
  double min_tipping_degrees = 0;      ///< least tilt at which that stack topples, degrees, in [0, 90]
  /// Coefficient of friction between copies, finite, >= 0: they do not jam (see Seating), and a stack that
  /// stands does not slide.
  std::optional<double> friction;
  std::optional<int> resting_part;  ///< part of the copy below on which alone copies rest
  /// Least distance along r that copies keep to other parts of the copy below, beyond the clearance, fraction
  /// of the extent, in (0, 1); with a resting part.
  double min_air_elsewhere = 0.002;
  /// Limits of what a person looks at, with z upwards. Not looked at if empty.
  std::optional<QualityLimits> quality;
};

/// Measures of quality that a check takes.
enum class QualityScope {
  all,    ///< all measures: QualityMeter::measure
  parts,  ///< the fast ones: QualityMeter::measure_parts
};

/// Returns the stackability that a length limit amounts to, with the height and the boxes at rest along a
/// direction. Throws UsageError where the length has no room for so many copies, however well they stack.
double target_within(const StackLengthLimit& limit, const RestShape& rest, const Direction& direction);

/// Throws UsageError for a target >= 1, a room out of range, negative lengths, fractions or angles, air of
/// more than a million diagonals, angles above 90 degrees, limits of quality out of
/// range, fewer than one standing copy, a tilt without
/// standing copies, parts that do not exist, numbers that are not finite, and options that measure flat
/// shapes.
void validate(const Requirements& requirements, const StructuredShape& rest);

/// Returns the constraints on a deformation model for stacking along `direction`: extent, box and fixed
/// parts. Fixed parts are the kept parts and, where editable parts are named, all parts that are neither
/// editable nor symmetric to an editable one; ascending.
DeformationConstraints deformation_constraints(const Requirements& requirements, const StructuredShape& rest,
                                               const Direction& direction);

/// Measures and checks of a design along one direction.
struct Assessment {
  Stackability measured;      ///< from the exact separation, f_max with clearance and play
  Separation separation;      ///< exact, without clearance and play; set by RequirementChecker::check only
  std::vector<Check> checks;  ///< one per requirement; set by `check` only
  /// Returns whether every check passed; true without checks.
  bool passed() const;
};

/// Checks designs of one space against requirements. The space must outlive the checker. Const, safe from any
/// number of threads.
class RequirementChecker {
 public:
  /// `rest`: the shape at rest of the space, with the measure of the requirements; if null, it is made here.
  /// Throws as `validate` and as the constructor of RestShape.
  RequirementChecker(const DeformationModel& space, Requirements requirements,
                     std::shared_ptr<const RestShape> rest = nullptr);

  const Requirements& requirements() const;  ///< the requirements given
  const DeformationModel& space() const;     ///< the space given; it must still exist
  const RestShape& rest_shape() const;       ///< what is known of the shape at rest
  /// Returns S(M, r) with the required clearance and play: the only measure that a search needs for every
  /// candidate. Within 1e-12 of the value that `check` compares with the target. Throws InputError for a
  /// shape without volume.
  Stackability measure(const Shape& shape, const Direction& direction) const;
  /// Returns the same unless S is certainly below `threshold`.
  std::optional<Stackability> measure_if_above(const Shape& shape, const Direction& direction,
                                               double threshold) const;
  /// Returns whether a design with these measures reaches the target or, where a room is required, fits into
  /// it. No slack.
  bool meets_target(const Stackability& measured) const;
  /// Returns the least S for which `meets_target` holds, up to rounding, for a design with the extent and
  /// boxes of `measured`.
  double required_stackability(const Stackability& measured) const;
  /// Returns what stands against the form of a design: its proportions, or the first measure of quality of
  /// QualityScope::parts beyond its limit. Cheap.
  std::optional<Obstacle> form_obstacle(const Design& design) const;
  /// Checks every requirement that was made, in the order of CheckKind. The target is compared without
  /// slack, from exact separations. The other quantities are computed in double precision and compared within
  /// tolerance::relative.
  ///
  /// * relations: recomputed, see DeformationModel::relation_residuals; they hold up to tolerance::relation,
  /// or
  ///   tolerance::visible where they are measured on the mesh;
  /// * parts: no vertex of a part that stays has moved. Where such a part shares vertices with one that may
  ///   change, models that edit primitives let the surface between them follow; there the primitive has not
  ///   moved;
  /// * thickness: every probe is at least as thick as required or, where the shape at rest is thinner, as at
  ///   rest;
  /// * draft, standing, jam and resting: for copies without clearance and play;
  /// * quality: one check per measure that has a limit, and is in the scope.
  Assessment check(const Design& design, const Direction& direction,
                   QualityScope scope = QualityScope::all) const;
  /// Returns the first check that `check` finds failed, but for those of the target. Nothing: the design is
  /// acceptable, and may only stack too little. Copies are separated only where a requirement of their
  /// contacts needs it, and S is not measured: cheap beside `check`. Throws as `check`, but for a shape
  /// without volume.
  std::optional<Check> obstacle(const Design& design, const Direction& direction,
                                QualityScope scope = QualityScope::all) const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

}  // namespace stackabilization
