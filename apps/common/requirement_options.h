#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/common/values.h"
#include "stackabilization/improvement/requirements.h"

namespace stackabilization::apps {

/// What is asked of designs besides S, as typed; what is left out is not asked for.
struct RequirementArguments {
  std::vector<std::string> kept, editable;  ///< names of parts
  bool change_height = false;
  std::optional<double> box_tolerance;  ///< fraction
  std::optional<Length> thickness, clearance, lateral_clearance;
  std::optional<double> draft_degrees, tipping_degrees;
  std::optional<int> standing;
  std::optional<double> friction;
  std::optional<std::string> resting;  ///< PART or PART=FRACTION
  std::vector<std::string> relaxed;    ///< NAME or NAME=VALUE
  bool any_quality = false;
};

/// Limits of quality with those that were relaxed. Throws UsageError for a name or a value that is none.
QualityLimits quality_limits_of(const std::vector<std::string>& relaxed);
/// The coefficient of friction between copies, as `--friction`.
Number friction_option(const std::string& description);
/// --relax.
void add_relax_option(CLI::App& command, std::vector<std::string>& relaxed);

/// --keep, --only, --change-height, --box-tolerance, --thickness, --clearance, --lateral-clearance,
/// --draft-degrees, --standing, --tilt-degrees, --friction, --rest-on, --relax, --any-quality.
void add_requirement_options(CLI::App& command, RequirementArguments& arguments);

/// A wish in place of a stackability: so many copies are to fit into a length along the direction.
struct StackRoom {
  std::optional<int> copies;     ///< --copies
  std::optional<Length> within;  ///< --within

  /// Nothing where it was not asked for. Throws UsageError as Length::in.
  std::optional<StackLengthLimit> limit(Unit unit) const;
};

/// --copies and --within.
void add_room_options(CLI::App& command, StackRoom& room);

/// Throws UsageError where one is given without the other, or beside --target.
void check(const StackRoom& room, const std::optional<double>& target);

/// --target, a stackability that can be reached.
Number target_option(const std::string& description);
/// --alpha.
Number alpha_option();

/// Throws UsageError for options that contradict each other.
void check(const RequirementArguments& arguments);

/// Whether the quality of designs is looked at when no option says so.
enum class QualityDefault { any, limited };

/// As the library has them, without target. Throws UsageError for parts that do not exist and lengths in
/// a unit that `rest` cannot be told in.
Requirements requirements_of(const RequirementArguments& arguments, const Shape& rest,
                             const StackabilityOptions& measure, QualityDefault quality);

}  // namespace stackabilization::apps
