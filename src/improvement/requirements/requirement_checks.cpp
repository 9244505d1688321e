#include "improvement/requirements/requirement_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "core/extract_parts.h"
#include "improvement/requirements/draft.h"
#include "improvement/requirements/size_ratios.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/deformation/tolerances.h"
#include "stackabilization/envelope/contacts.h"
#include "stackabilization/improvement/tolerances.h"
#include "stackabilization/stacking/seating.h"
#include "stackabilization/stacking/static_stability.h"

namespace stackabilization::detail {

namespace {

/// Returns, per vertex, the parts whose triangles use it.
std::vector<std::set<int>> owners_of(const Shape& shape) {
  std::vector<std::set<int>> owners(static_cast<std::size_t>(shape.vertex_count()));
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k)
      owners[static_cast<std::size_t>(shape.triangles(t, k))].insert(
          shape.triangle_part[static_cast<std::size_t>(t)]);
  return owners;
}

double primitive_displacement(const Primitive& rest, const Primitive& now) {
  double farthest = (control_points(now) - control_points(rest)).rowwise().norm().maxCoeff();
  if (const auto* cylinder = std::get_if<GeneralizedCylinder>(&rest))
    farthest = std::max(farthest,
                        (std::get<GeneralizedCylinder>(now).radii - cylinder->radii).cwiseAbs().maxCoeff());
  return farthest;
}

}  // namespace

RequirementChecks::RequirementChecks(const DeformationModel& space, const Requirements& requirements,
                                     std::vector<int> stay)
    : space_(space), requirements_(requirements) {
  const Shape& rest = space.rest().shape;
  const std::set<int> staying(stay.begin(), stay.end());
  const std::vector<std::set<int>> owners = staying.empty() ? std::vector<std::set<int>>() : owners_of(rest);
  for (const int part : stay) {
    StayingPart entry{part, {}, false};
    for (std::size_t v = 0; v < owners.size(); ++v) {
      if (!owners[v].contains(part)) continue;
      entry.vertices.push_back(static_cast<Eigen::Index>(v));
      const bool seam = !std::includes(staying.begin(), staying.end(), owners[v].begin(), owners[v].end());
      if (seam && space.capabilities().edits_primitives) entry.by_primitive = true;
    }
    if (entry.by_primitive) entry.vertices.clear();
    staying_.push_back(std::move(entry));
  }
  if (requirements.min_thickness) probes_ = thickness_probes(rest);
  if (requirements.quality) meter_.emplace(space.rest());
}

std::vector<Check> RequirementChecks::of_one_copy(const Design& design, const Direction& direction) const {
  std::vector<Check> checks;
  if (requirements_.keep_height) checks.push_back(height(design.shape, direction));
  checks.push_back(relations(design));
  if (requirements_.min_size_ratio > 0) checks.push_back(proportions(design));
  if (requirements_.box_tolerance) checks.push_back(box(design.shape));
  if (!staying_.empty()) checks.push_back(parts(design));
  if (requirements_.min_thickness) checks.push_back(thickness(design.shape));
  return checks;
}

bool RequirementChecks::need_contacts() const {
  return requirements_.min_draft_degrees || requirements_.standing_copies || requirements_.friction ||
         requirements_.resting_part;
}

std::vector<Check> RequirementChecks::of_contacts(const StackedDesign& stacked) const {
  std::vector<Check> checks;
  if (requirements_.min_draft_degrees) checks.push_back(draft(stacked));
  if (requirements_.standing_copies) checks.push_back(standing(stacked));
  if (requirements_.friction) checks.push_back(jam(stacked));
  if (requirements_.resting_part) checks.push_back(resting(stacked));
  return checks;
}

std::vector<Check> RequirementChecks::quality(const Design& design, QualityScope scope) const {
  std::vector<Check> checks;
  if (!requirements_.quality) return checks;
  const QualityLimits& limits = *requirements_.quality;
  const std::vector<QualityValue> values =
      scope == QualityScope::all ? meter_->measure(design.shape) : meter_->measure_parts(design.shape);
  for (const QualityValue& value : values) {
    if (!limits.is_limited(value.measure)) continue;
    Check check{CheckKind::quality, value.value, limits[value.measure], is_within(value, limits), value.part};
    check.measure = value.measure;
    check.other = value.other;
    checks.push_back(check);
  }
  return checks;
}

Check RequirementChecks::reached(const Stackability& measured) const {
  if (!requirements_.length_limit)
    return {CheckKind::target, measured.value, requirements_.target, measured.value >= requirements_.target};
  const double length = measured.stack_height(requirements_.length_limit->copies),
               room = requirements_.length_limit->length;
  return {CheckKind::room, length, room, length <= room};
}

Check RequirementChecks::height(const Shape& shape, const Direction& direction) const {
  const Eigen::Vector3d axis = direction.unit();
  const double rest = range_along(space_.rest().shape, axis).length();
  const double change = std::abs(range_along(shape, axis).length() - rest) / rest;
  return {CheckKind::height, change, tolerance::relative, change <= tolerance::relative};
}

Check RequirementChecks::relations(const Design& design) const {
  const std::vector<double> residuals = space_.relation_residuals(design);
  // The triangles of a mesh are hardly ever as symmetric as its shape.
  Check check{CheckKind::relations, 0,
              space_.capabilities().edits_primitives ? tolerance::relation : tolerance::visible};
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    if (residuals[i] <= check.value || std::isnan(check.value)) continue;
    check.value = residuals[i];
    check.where = static_cast<int>(i);
  }
  check.passed = check.value <= check.demanded;
  return check;
}

Check RequirementChecks::proportions(const Design& design) const {
  const SizeRatio least = min_size_ratio(space_.rest(), design);
  Check check{CheckKind::proportions, least.ratio, requirements_.min_size_ratio};
  check.passed = least.ratio >= check.demanded - tolerance::relative;
  check.where = least.part;
  return check;
}

Check RequirementChecks::box(const Shape& shape) const {
  Check check{CheckKind::box, 0, *requirements_.box_tolerance};
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d along = Eigen::Vector3d::Unit(axis);
    const double rest = range_along(space_.rest().shape, along).length();
    const double change = std::abs(range_along(shape, along).length() - rest) / rest;
    if (change <= check.value) continue;
    check.value = change;
    check.where = axis;
  }
  check.passed = check.value <= check.demanded + tolerance::relative;
  return check;
}

double RequirementChecks::displacement(const StayingPart& staying, const Design& design) const {
  const StructuredShape& rest = space_.rest();
  const auto part = static_cast<std::size_t>(staying.part);
  double farthest = 0;
  if (staying.by_primitive)
    farthest = primitive_displacement(rest.structure.parts[part].primitive, design.primitives[part]);
  for (const Eigen::Index v : staying.vertices)
    farthest = std::max(farthest, (design.shape.vertices.row(v) - rest.shape.vertices.row(v)).norm());
  return farthest / rest.structure.diagonal;
}

Check RequirementChecks::parts(const Design& design) const {
  Check check{CheckKind::parts, 0, tolerance::relative};
  for (const StayingPart& staying : staying_) {
    const double moved = displacement(staying, design);
    if (moved <= check.value) continue;
    check.value = moved;
    check.where = staying.part;
  }
  check.passed = check.value <= check.demanded;
  return check;
}

Check RequirementChecks::thickness(const Shape& shape) const {
  const double least = *requirements_.min_thickness;
  Check check{CheckKind::thickness, 0, least, true};
  // `worst`: least excess over the required thickness, which decides. `thinnest`: least thickness, which is
  // reported.
  double worst = std::numeric_limits<double>::infinity(), thinnest = worst;
  for (const ThicknessProbe& probe : probes_) {
    const double measured = stackabilization::thickness(probe, shape);
    const double excess = measured - std::min(least, probe.at_rest);
    thinnest = std::min(thinnest, measured);
    if (excess >= worst) continue;
    worst = excess;
    check.where = shape.triangle_part[static_cast<std::size_t>(probe.near_triangle)];
  }
  if (probes_.empty()) return check;
  check.value = thinnest;
  check.passed = worst >= -tolerance::relative * space_.rest().structure.diagonal;
  return check;
}

Check RequirementChecks::draft(const StackedDesign& stacked) const {
  const double least = *requirements_.min_draft_degrees;
  const Shape& shape = stacked.design.shape;
  Check check{CheckKind::draft, 90, least, true};
  if (!stacked.separation.blocked) return check;
  ContactOptions options;
  options.semantics = requirements_.measure.semantics;
  check.value = contact_draft_degrees(
      shape, contact_regions({shape, stacked.tree, stacked.direction, stacked.separation}, options).regions,
      stacked.direction);
  check.passed = check.value >= least * (1 - tolerance::relative);
  return check;
}

Check RequirementChecks::standing(const StackedDesign& stacked) const {
  Check check{CheckKind::standing, 0, requirements_.min_tipping_degrees};
  if (!stacked.separation.blocked) return check;
  StaticStabilityOptions options;
  options.copies = *requirements_.standing_copies;
  options.semantics = requirements_.measure.semantics;
  options.up = up_of_stack(stacked.direction);
  options.friction = requirements_.friction;
  const StaticStability stack =
      stackabilization::static_stability(stacked.design.shape, stacked.direction, options);
  check.value = stack.tipping_degrees;
  check.passed = stack.stands && stack.tipping_degrees >= check.demanded * (1 - tolerance::relative);
  check.where = stack.weakest_copy;
  check.copies = options.copies;
  return check;
}

Check RequirementChecks::jam(const StackedDesign& stacked) const {
  Check check{CheckKind::jam, 0, 0, true};
  if (!stacked.separation.blocked) return check;
  SeatingOptions options;
  options.friction = *requirements_.friction;
  options.semantics = requirements_.measure.semantics;
  options.up = up_of_stack(stacked.direction);
  const Seating seat = seating(stacked.design.shape, stacked.direction, options);
  check.value = std::max(seat.pull_off, seat.walls_pull_off);
  check.passed = !seat.jams();
  if (seat.jams()) check.where = seat.pull_off > 0 ? seat.upper_part : seat.tight.front().upper_part;
  return check;
}

/// Compares f_max with the separation from every other part of the copy below.
Check RequirementChecks::resting(const StackedDesign& stacked) const {
  Check check{CheckKind::resting, 0, requirements_.min_air_elsewhere};
  if (!stacked.separation.blocked) return check;
  const Shape& shape = stacked.design.shape;
  const double extent = range_along(shape, stacked.direction.unit()).length();
  check.value = 1;
  const std::vector<Shape> parts = extract_parts(shape);
  for (std::size_t part = 0; part < parts.size(); ++part) {
    if (static_cast<int>(part) == *requirements_.resting_part || parts[part].triangle_count() == 0) continue;
    const Separation other = separation(SeparationTree(parts[part]), stacked.tree, stacked.direction,
                                        {requirements_.measure.semantics, std::nullopt});
    if (!other.blocked) continue;
    const double air = (stacked.separation.length - other.length) / extent;
    if (air >= check.value) continue;
    check.value = air;
    check.where = static_cast<int>(part);
  }
  check.passed = check.value >= check.demanded * (1 - tolerance::relative);
  return check;
}

}  // namespace stackabilization::detail
