#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "stackabilization/deformation/refusal.h"
#include "stackabilization/improvement/quality.h"

namespace stackabilization {

/// Requirements of a design, in the order in which they are checked.
enum class CheckKind {
  target,       ///< S
  room,         ///< length of the stack, model units; instead of the target
  height,       ///< change of h over h
  relations,    ///< largest residual, fraction of the diagonal
  proportions,  ///< least ratio of sizes, to the size at rest
  box,          ///< largest change of a side of the box, fraction of the side
  parts,        ///< largest displacement of a part that stays, fraction of the diagonal
  thickness,    ///< least thickness, model units
  draft,        ///< least draft angle, degrees
  standing,     ///< tilt at which the stack topples, degrees
  jam,          ///< force that pulls a copy off, fraction of that with which it was pressed on
  resting,      ///< distance along r to parts on which copies are not to rest, fraction of the extent
  quality,      ///< a measure of quality, in its unit
};

/// Result of one requirement for one design.
struct Check {
  CheckKind kind = CheckKind::target;  ///< the requirement, and the quantity of `value` with its unit
  double value = 0;                    ///< measured quantity
  double demanded = 0;                 ///< required value, or the tolerance of the comparison
  bool passed = false;                 ///< whether `value` satisfies `demanded`
  /// Where `value` was found: relations: row of the relation; proportions, parts and thickness: the part;
  /// box: the axis, 0 to 2; standing: the copy that topples first, from 0; jam: the part of the copy below;
  /// resting: the part that is not to be touched. -1 where nothing changed, nothing has a thickness, nothing
  /// jams, or copies pass each other.
  int where = -1;
  int copies = 0;                                              ///< standing: number of copies in the stack
  QualityMeasure measure = QualityMeasure::self_intersection;  ///< quality: what was measured
  int other = -1;                                              ///< quality: QualityValue::other

  /// Returns whether the check says how well the shape stacks: of the target, or of the room in its place.
  bool is_of_target() const { return kind == CheckKind::target || kind == CheckKind::room; }

  /// Compares the members in their order.
  auto operator<=>(const Check&) const = default;
};

/// Returns the name of a requirement: that of its enumerator; for quality "quality: " and the name of the
/// measure.
std::string name_of(const Check& check);

/// Returns the unit of Check::value: "", "model units", "degrees", "of the diagonal", "of the height", "of
/// the size at rest", "of a side" or "of the force"; for quality that of the measure.
std::string unit_of(const Check& check);

/// Returns how far a check is violated, on a scale that all kinds share: > 0 if it fails, <= 0 if not.
double violation(const Check& check);

/// Returns where and why a check has its value, one clause; may be empty. `rest`: structure of the shape at
/// rest.
std::string note_of(const Check& check, const Structure& rest);

/// What stands against a design: the edit that makes it is refused, or the design fails a check.
using Obstacle = std::variant<Refusal, Check>;

/// Returns an obstacle to an edit as one sentence without a full stop.
std::string describe(const Obstacle& obstacle, const Structure& rest);

/// Returns an obstacle without its amounts, for counting: of a check only what is checked.
Obstacle without_amounts(const Obstacle& obstacle);

/// How often an obstacle was met in a search: how many edits were refused for it, or how many designs that
/// reach the target failed the check.
struct ObstacleCount {
  Obstacle obstacle;       ///< without amounts; a check has its kind only
  std::int64_t count = 0;  ///< number of edits or designs
};

/// Returns the obstacle as one sentence without amounts, and the count: "'leg' is fixed (12 edits)".
std::string describe(const ObstacleCount& count, const Structure& rest);

/// Sorts the counts: the most frequent first, equal ones in the alphabetical order of their sentences.
void sort_by_count(std::vector<ObstacleCount>& counts, const Structure& rest);

}  // namespace stackabilization
