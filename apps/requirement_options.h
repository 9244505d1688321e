#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/values.h"
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
};

/// --keep, --only, --change-height, --box-tolerance, --thickness, --clearance, --lateral-clearance,
/// --draft-degrees, --standing, --tilt-degrees.
void add_requirement_options(CLI::App& command, RequirementArguments& arguments);

/// --target, a stackability that can be reached.
Number target_option(const std::string& description);
/// --alpha.
Number alpha_option();

/// Throws UsageError for options that contradict each other.
void check(const RequirementArguments& arguments);

/// As the library has them, without target. Throws UsageError for parts that do not exist and lengths in
/// a unit that `rest` cannot be told in.
Requirements requirements_of(const RequirementArguments& arguments, const Shape& rest,
                             const StackabilityOptions& measure);

}  // namespace stackabilization::apps
