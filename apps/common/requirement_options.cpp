#include "apps/common/requirement_options.h"

#include <algorithm>

#include "apps/common/structured_model.h"
#include "apps/common/text.h"

namespace stackabilization::apps {

namespace {

/// A larger limit of a measure of quality is a typing error: --relax NAME removes it.
constexpr double max_quality_limit = 1000;
/// More friction is a typing error.
constexpr double max_friction = 100;

/// Part of --rest-on and, behind the last sign, what is given as air.
std::pair<std::string, std::optional<double>> resting_of(const std::string& text) {
  const std::size_t sign = text.rfind('=');
  if (sign == std::string::npos) return {text, std::nullopt};
  return {text.substr(0, sign), parse_fraction("--rest-on", text.substr(sign + 1))};
}

}  // namespace

Number friction_option(const std::string& description) {
  return {.name = "--friction", .description = description, .min = 0, .max = max_friction};
}

Number target_option(const std::string& description) {
  // Copies without any height of their own have S = 1; below the other end nobody wishes for anything.
  return {.name = "--target", .description = description, .min = -1000, .max = 1, .open_max = true};
}

std::optional<StackLengthLimit> StackRoom::limit(Unit unit) const {
  return within ? std::optional(StackLengthLimit{*copies, within->in(unit)}) : std::nullopt;
}

void add_room_options(CLI::App& command, StackRoom& room) {
  add_count(command, {"--copies", "Instead: so many copies are to fit ...", 2, max_copies}, room.copies);
  add_length(command, {"--within", "... into this length along the direction, as 1.5 or 150cm", true},
             room.within);
}

void check(const StackRoom& room, const std::optional<double>& target) {
  if (target && (room.copies || room.within))
    throw UsageError("--target and --copies with --within are two ways to say the same: give one of them");
  if (room.copies.has_value() != room.within.has_value())
    throw UsageError("--copies and --within go together: how many copies within what length");
}

Number alpha_option() {
  return {"--alpha", "Weight of the distortion in the energy (default: 0.2)", 0, 1};
}

void add_requirement_options(CLI::App& command, RequirementArguments& arguments) {
  add_parts(command, "--keep", arguments.kept, "Part that stays as it is; repeatable");
  add_parts(command, "--only", arguments.editable,
            "Part that may change, and no other but those symmetric to it; repeatable");
  command.add_flag("--change-height", arguments.change_height,
                   "The height along the direction need not stay what it is");
  add_fraction(command, "--box-tolerance", arguments.box_tolerance,
               "Fraction by which the sides of the box along x, y and z may change, as 0.05 or 5%");
  add_length(command, {"--thickness", "Walls get no thinner than this; what is thinner already may stay so"},
             arguments.thickness);
  add_length(command, {"--clearance", "Air between copies along the direction, as 0.5 or 2mm"},
             arguments.clearance);
  add_length(command, {"--lateral-clearance", "Sideways play that every contact allows"},
             arguments.lateral_clearance);
  add_number(command,
             {"--draft-degrees", "Least angle between the direction and surfaces that copies touch with", 0,
              max_degrees},
             arguments.draft_degrees);
  add_count(command, {"--standing", "A stack of so many copies stands by itself", 1, max_copies},
            arguments.standing);
  add_number(
      command,
      {"--tilt-degrees", "... also on ground that is tilted by this angle (default: 0)", 0, max_degrees},
      arguments.tipping_degrees);
  add_number(command,
             friction_option("Coefficient of friction between copies, with which they do not jam, nor slide "
                             "in the stack of --standing"),
             arguments.friction);
  command
      .add_option("--rest-on", arguments.resting,
                  "Copies rest on this part of the one below, and keep FRACTION of the height away from its "
                  "other parts (default: 0.2%)")
      ->type_name("PART[=FRACTION]");
  add_relax_option(command, arguments.relaxed);
  command.add_flag("--any-quality", arguments.any_quality,
                   "Do not look at the quality of designs, as the paper (default with --preset paper, and in "
                   "suggest without --edits smooth)");
}

void add_relax_option(CLI::App& command, std::vector<std::string>& relaxed) {
  command
      .add_option("--relax", relaxed,
                  "Another limit for a measure of quality, as size=0.6, or none: size; repeatable")
      ->type_name("NAME[=VALUE]");
}

QualityLimits quality_limits_of(const std::vector<std::string>& relaxed) {
  QualityLimits limits;
  for (const std::string& word : relaxed) {
    const std::size_t sign = word.find('=');
    const auto measure = quality_measure_of(word.substr(0, sign));
    if (!measure) {
      std::string names;
      for (std::size_t k = 0; k < quality_measure_count; ++k)
        names += (k == 0 ? "" : ", ") + name_of(static_cast<QualityMeasure>(k));
      throw UsageError("--relax expects a measure of quality, found '" + word.substr(0, sign) +
                       "'; there are " + names);
    }
    if (sign == std::string::npos) {
      limits.relax(*measure);
      continue;
    }
    const bool ratio = has_lower_limit(*measure);
    const Number limit{.name = "--relax " + name_of(*measure),
                       .description = "",
                       .min = 0,
                       .max = ratio ? 1 : max_quality_limit};
    limits[*measure] = parse_number(limit, word.substr(sign + 1));
  }
  return limits;
}

void check(const RequirementArguments& arguments) {
  if (arguments.any_quality && !arguments.relaxed.empty())
    throw UsageError("--relax and --any-quality contradict each other");
  quality_limits_of(arguments.relaxed);
  if (arguments.tipping_degrees && !arguments.standing)
    throw UsageError(
        "--tilt-degrees is the tilt at which the stack of --standing still stands: give that too");
  for (const std::string& name : arguments.kept)
    if (std::find(arguments.editable.begin(), arguments.editable.end(), name) != arguments.editable.end())
      throw UsageError("--keep and --only contradict each other: both name '" + name + "'");
}

Requirements requirements_of(const RequirementArguments& arguments, const Shape& rest,
                             const StackabilityOptions& measure, QualityDefault quality) {
  const Unit unit = rest.unit;
  Requirements requirements;
  requirements.measure = measure;
  requirements.keep_height = !arguments.change_height;
  requirements.kept_parts = parts_named("--keep", arguments.kept, rest);
  requirements.editable_parts = parts_named("--only", arguments.editable, rest);
  requirements.box_tolerance = arguments.box_tolerance;
  if (arguments.thickness) requirements.min_thickness = length_in(arguments.thickness, unit);
  requirements.measure.clearance = length_in(arguments.clearance, unit);
  requirements.measure.play = length_in(arguments.lateral_clearance, unit);
  requirements.min_draft_degrees = arguments.draft_degrees;
  requirements.standing_copies = arguments.standing;
  requirements.min_tipping_degrees = arguments.tipping_degrees.value_or(0);
  requirements.friction = arguments.friction;
  if (arguments.resting) {
    const auto [part, air] = resting_of(*arguments.resting);
    requirements.resting_part = parts_named("--rest-on", {part}, rest).front();
    requirements.min_air_elsewhere = air.value_or(requirements.min_air_elsewhere);
  }
  if (!arguments.any_quality && (quality == QualityDefault::limited || !arguments.relaxed.empty()))
    requirements.quality = quality_limits_of(arguments.relaxed);
  return requirements;
}

}  // namespace stackabilization::apps
