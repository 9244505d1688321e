#include "stackabilization/improvement/requirements.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "improvement/design/design_match.h"
#include "improvement/requirements/requirement_checks.h"
#include "improvement/requirements/size_ratios.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/number_text.h"
#include "stackabilization/improvement/removal.h"
#include "stackabilization/stacking/plan.h"

namespace stackabilization {

namespace {

/// Largest clearance and play, in diagonals. Larger values are a mistake in the unit, and numbers that no
/// file can hold.
constexpr double max_air = 1e6;

void require_at_least_zero(double value, const std::string& what) {
  if (!std::isfinite(value) || value < 0)
    throw UsageError("the " + what + " that is required must be a finite number of at least 0");
}

void require_air(double value, const std::string& what, double diagonal) {
  require_at_least_zero(value, what);
  if (value > max_air * diagonal)
    throw UsageError("the " + what + " that is required cannot exceed a million times the size of the shape");
}

void require_angle(double degrees, const std::string& what) {
  require_at_least_zero(degrees, what);
  if (degrees > 90) throw UsageError("the " + what + " that is required cannot exceed 90 degrees");
}

void require_parts(const std::vector<int>& parts, const Structure& structure) {
  for (const int part : parts)
    if (part < 0 || static_cast<std::size_t>(part) >= structure.parts.size())
      throw UsageError("there is no part " + std::to_string(part) + ": the shape has " +
                       std::to_string(structure.parts.size()));
}

void require_length_limit(const StackLengthLimit& room) {
  if (room.copies < 2) throw UsageError("a room is for two copies at least");
  if (!std::isfinite(room.length) || room.length <= 0)
    throw UsageError("the room for a stack must be a finite positive length");
}

std::vector<int> parts_that_stay(const Requirements& requirements, const Structure& structure) {
  std::set<int> stay(requirements.kept_parts.begin(), requirements.kept_parts.end());
  if (!requirements.editable_parts.empty()) {
    const std::set<int> editable(requirements.editable_parts.begin(), requirements.editable_parts.end());
    for (const std::vector<int>& members : symmetric_classes(structure))
      if (std::none_of(members.begin(), members.end(), [&](int part) { return editable.contains(part); }))
        stay.insert(members.begin(), members.end());
  }
  return {stay.begin(), stay.end()};
}

Requirements validated(Requirements requirements, const StructuredShape& rest) {
  validate(requirements, rest);
  return requirements;
}

std::optional<Check> first_failed(const std::vector<Check>& checks) {
  const auto failed =
      std::find_if(checks.begin(), checks.end(), [](const Check& check) { return !check.passed; });
  return failed == checks.end() ? std::nullopt : std::optional(*failed);
}

}  // namespace

void validate(const Requirements& requirements, const StructuredShape& rest) {
  if (!std::isfinite(requirements.target) || requirements.target >= 1)
    throw UsageError("the target must be a stackability below 1");
  if (requirements.measure.flat_shapes != FlatShapes::refuse)
    throw UsageError("a target needs shapes whose box has a volume");
  if (requirements.length_limit) require_length_limit(*requirements.length_limit);
  require_parts(requirements.kept_parts, rest.structure);
  require_parts(requirements.editable_parts, rest.structure);
  if (!(requirements.min_size_ratio >= 0 && requirements.min_size_ratio <= 1))
    throw UsageError("the least proportion that is required must be from 0 to 1");
  require_air(requirements.measure.clearance, "clearance", rest.structure.diagonal);
  require_air(requirements.measure.play, "play", rest.structure.diagonal);
  require_at_least_zero(requirements.box_tolerance.value_or(0), "tolerance of the box");
  require_at_least_zero(requirements.min_thickness.value_or(0), "thickness");
  require_angle(requirements.min_draft_degrees.value_or(0), "draft angle");
  require_angle(requirements.min_tipping_degrees, "tilt");
  require_at_least_zero(requirements.friction.value_or(0), "friction");
  if (requirements.resting_part) require_parts({*requirements.resting_part}, rest.structure);
  if (!(requirements.min_air_elsewhere > 0 && requirements.min_air_elsewhere < 1))
    throw UsageError(
        "the air beside the part on which copies rest must be a fraction of the height between 0 and 1");
  if (requirements.quality) validate(*requirements.quality);
  if (requirements.standing_copies.value_or(1) < 1)
    throw UsageError("a stack that stands needs at least one copy");
  if (requirements.min_tipping_degrees > 0 && !requirements.standing_copies)
    throw UsageError("a least tilt needs the number of copies that are to stand");
}

double target_within(const StackLengthLimit& limit, const RestShape& rest, const Direction& direction) {
  require_length_limit(limit);
  const double clearance = rest.options().clearance;
  const Stackability measured = rest.measure(direction);
  const StackPlan plan = plan_stack(measured, {limit.copies, limit.length, clearance});
  if (!plan.possible || *plan.stackability >= 1)
    throw UsageError("the length " + shortest_text(limit.length) + " has no room for " +
                     std::to_string(limit.copies) + " copies of height " + shortest_text(measured.extent) +
                     (clearance > 0 ? " with " + shortest_text(clearance) + " of air between them" : "") +
                     ", however well they stack");
  return *plan.stackability;
}

DeformationConstraints deformation_constraints(const Requirements& requirements, const StructuredShape& rest,
                                               const Direction& direction) {
  DeformationConstraints constraints;
  if (requirements.keep_height) {
    constraints.keep_extent = direction;
    constraints.extent_ends = ExtentEnds::fixed;
  }
  constraints.box_tolerance = requirements.box_tolerance;
  constraints.fixed_parts = parts_that_stay(requirements, rest.structure);
  return constraints;
}

bool Assessment::passed() const {
  return std::all_of(checks.begin(), checks.end(), [](const Check& check) { return check.passed; });
}

struct RequirementChecker::Data {
  Data(const DeformationModel& designs, Requirements required, std::shared_ptr<const RestShape> known)
      : space(designs),
        requirements(validated(std::move(required), designs.rest())),
        rest(known ? std::move(known)
                   : std::make_shared<const RestShape>(designs.rest(), requirements.measure)),
        primitives(detail::primitives_of(designs.rest().structure)),
        checks(designs, requirements, parts_that_stay(requirements, designs.rest().structure)) {}

  const DeformationModel& space;
  Requirements requirements;
  std::shared_ptr<const RestShape> rest;
  std::vector<Primitive> primitives;  ///< at rest
  detail::RequirementChecks checks;
};

RequirementChecker::RequirementChecker(const DeformationModel& space, Requirements requirements,
                                       std::shared_ptr<const RestShape> rest)
    : data_(std::make_shared<const Data>(space, std::move(requirements), std::move(rest))) {}

const Requirements& RequirementChecker::requirements() const {
  return data_->requirements;
}

const DeformationModel& RequirementChecker::space() const {
  return data_->space;
}

const RestShape& RequirementChecker::rest_shape() const {
  return *data_->rest;
}

Stackability RequirementChecker::measure(const Shape& shape, const Direction& direction) const {
  return stackability(shape, direction, data_->requirements.measure);
}

std::optional<Stackability> RequirementChecker::measure_if_above(const Shape& shape,
                                                                 const Direction& direction,
                                                                 double threshold) const {
  return stackability_if_above(shape, direction, threshold, data_->requirements.measure);
}

bool RequirementChecker::meets_target(const Stackability& measured) const {
  const Requirements& asked = data_->requirements;
  return asked.length_limit ? measured.stack_height(asked.length_limit->copies) <= asked.length_limit->length
                            : measured.value >= asked.target;
}

double RequirementChecker::required_stackability(const Stackability& measured) const {
  const std::optional<StackLengthLimit>& room = data_->requirements.length_limit;
  return room ? stackability_within(measured, room->copies, room->length) : data_->requirements.target;
}

std::optional<Obstacle> RequirementChecker::form_obstacle(const Design& design) const {
  if (data_->requirements.min_size_ratio > 0) {
    const SizeRatio size_ratio = min_size_ratio(data_->space.rest(), design);
    if (size_ratio.ratio < data_->requirements.min_size_ratio)
      return Refusal{.cause = RefusalCause::proportions, .part = size_ratio.part};
  }
  return first_failed(data_->checks.quality(design, QualityScope::parts));
}

Assessment RequirementChecker::check(const Design& design, const Direction& direction,
                                     QualityScope scope) const {
  detail::require_match(design, data_->primitives, data_->space.rest().shape.vertex_count());
  validate(design.shape);
  const SeparationTree tree(design.shape);
  const ExactStackability exact = measure_exact(design.shape, tree, direction, data_->requirements.measure);
  Assessment assessment;
  assessment.measured = exact.stackability;
  assessment.separation = exact.separation;
  assessment.checks = {data_->checks.reached(assessment.measured)};
  const auto add = [&](const std::vector<Check>& checks) {
    assessment.checks.insert(assessment.checks.end(), checks.begin(), checks.end());
  };
  add(data_->checks.of_one_copy(design, direction));
  add(data_->checks.of_contacts({design, tree, direction, assessment.separation}));
  add(data_->checks.quality(design, scope));
  return assessment;
}

std::optional<Check> RequirementChecker::obstacle(const Design& design, const Direction& direction,
                                                  QualityScope scope) const {
  detail::require_match(design, data_->primitives, data_->space.rest().shape.vertex_count());
  validate(design.shape);
  if (const auto failed = first_failed(data_->checks.of_one_copy(design, direction))) return failed;
  if (data_->checks.need_contacts()) {
    const SeparationTree tree(design.shape);
    const Separation separated =
        separation(tree, tree, direction, {data_->requirements.measure.semantics, std::nullopt});
    if (const auto failed = first_failed(data_->checks.of_contacts({design, tree, direction, separated})))
      return failed;
  }
  return first_failed(data_->checks.quality(design, scope));
}

}  // namespace stackabilization
