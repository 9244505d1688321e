#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/improvement/design.h"
#include "stackabilization/stacking/stackability.h"

namespace stackabilization {

/// So many copies that fit into a length along r: h + (copies - 1) f_max <= length.
struct StackRoom {
  int copies = 2;     ///< >= 2
  double length = 0;  ///< model units, > 0
};

/// What a designer asks of a solution. A design that breaks one of these is none.
struct Requirements {
  double target = 0;  ///< S(M, r) to be reached, < 1
  /// Asked for instead of the target, which is then for reports only: how S and the length go together
  /// depends on boxes, which change with the design.
  std::optional<StackRoom> room;
  StackabilityOptions measure;      ///< what S means; boxes and semantics of all measurements
  bool keep_height = true;          ///< h(M, r) = h(M0, r), to tolerance::relative of it
  std::vector<int> kept_parts;      ///< stay as they are
  std::vector<int> editable_parts;  ///< only these and parts symmetric to them may change; empty: all
  /// Sizes of parts shrink to no less than this fraction of what they are at rest and grow to no more than
  /// its inverse (proportions.h); in [0, 1], 0: anything goes.
  double least_proportion = 0.4;
  std::optional<double> box_tolerance;    ///< sides of the file's box change by this fraction at most
  std::optional<double> least_thickness;  ///< model units; what is thinner at rest may stay as thin as it is
  /// Air between copies. The f_max of the target is then that of a stack with this air (separation_with_play
  /// plus clearance).
  double clearance = 0, play = 0;             ///< along r, and sideways; model units, >= 0
  std::optional<double> least_draft_degrees;  ///< between r and every surface that copies touch with
  std::optional<int> standing_copies;         ///< a stack of so many must stand
  double least_tilt_degrees = 0;              ///< and topple only beyond this tilt
};

/// Throws UsageError for a target >= 1, a room out of range, negative lengths, fractions or angles, air of
/// more than a million diagonals, angles above 90 degrees, fewer than one standing copy, a tilt without such
/// copies, parts that do not exist, anything not finite.
void validate(const Requirements& requirements, const StructuredShape& rest);

/// What they forbid a deformation model, for stacking along `direction`: extent, box, parts that stay (those
/// kept, and all but the editable ones and those symmetric to them where some are named; in order).
DeformationConstraints deformation_constraints(const Requirements& requirements, const StructuredShape& rest,
                                               const Direction& direction);

/// One requirement held against one design.
struct Check {
  /// "target" or "room", "height", "relations", "proportions", "box", "parts", "thickness", "draft",
  /// "standing"
  std::string name;
  double value =
      0;  ///< what was measured: S or the length of the stack, change of h, worst residual, largest change of
          ///< a side, farthest displacement, least thickness, least draft, tilt at which a stack topples
  double demanded = 0;  ///< what was asked for, or the tolerance to which it is held
  bool passed = false;  ///< `value` is on the right side of `demanded`
  std::string unit;     ///< "", "model units", "degrees", "of the diagonal", "of the height", "of a side"
  std::string note;     ///< where and why; may be empty
};

/// A design measured along one direction.
struct Assessment {
  Stackability measured;      ///< from the exact separation, f_max with the air asked for
  Separation separation;      ///< exact, without air; only from `RequirementChecker::checked`
  std::vector<Check> checks;  ///< only from `checked`
  /// Whether every check passed; also true where none was made.
  bool passed() const;
};

/// Holds designs of one space against requirements. The space must outlive it. Const, safe from any number of
/// threads.
class RequirementChecker {
 public:
  /// Throws as `validate`.
  RequirementChecker(const DesignSpace& space, Requirements requirements);

  const Requirements& requirements() const;  ///< as given
  const DesignSpace& space() const;          ///< as given; must still be alive
  /// S(M, r), with the air that is asked for: the one number that a search needs for every candidate. Within
  /// 1e-12 of what `checked` holds against the target. Throws InputError for a shape without volume.
  Stackability measured(const Shape& shape, const Direction& direction) const;
  /// The same unless S is certainly below `threshold`.
  std::optional<Stackability> measured_above(const Shape& shape, const Direction& direction,
                                             double threshold) const;
  /// Does a design so measured reach the target or, where one is asked for, fit into the room? Without slack.
  bool reaches(const Stackability& measured) const;
  /// S from which on `reaches` holds, up to rounding, for a design of such an extent and such boxes.
  double needed(const Stackability& measured) const;
  /// Why a design is out of proportion, if it is: one clause. Cheap.
  std::optional<std::string> out_of_proportion(const Design& design) const;
  /// Everything: each requirement that was made, in the order of Check::name. The target is compared without
  /// slack, from exact separations; the others are constructions in double precision and pass to
  /// tolerance::relative.
  ///
  /// * relations: only for controllers, recomputed from the primitives;
  /// * parts: no vertex of a part that stays has moved. Where such a part shares vertices with one that may
  ///   change, controllers let the surface between them follow: there its primitive has not;
  /// * thickness: at every probe at least what is asked for or, where the shape at rest is thinner, what that
  ///   has there;
  /// * draft: at the contacts of the copies without air.
  Assessment checked(const Design& design, const Direction& direction) const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

}  // namespace stackabilization
