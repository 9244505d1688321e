#include <cstdint>
#include <optional>
#include <variant>

#include "improvement/search/search_state.h"
#include "stackabilization/core/fingerprint.h"

namespace stackabilization::detail {

namespace {

void add_count(Fingerprint& print, std::size_t count) {
  print.add(static_cast<std::uint64_t>(count));
}

void add_integer(Fingerprint& print, int value) {
  print.add(static_cast<std::uint64_t>(static_cast<std::int64_t>(value)));
}

void add_integers(Fingerprint& print, const std::vector<int>& values) {
  add_count(print, values.size());
  for (const int value : values) add_integer(print, value);
}

void add_optional(Fingerprint& print, const std::optional<double>& value) {
  add_integer(print, value ? 1 : 0);
  if (value) print.add(*value);
}

void add(Fingerprint& print, const Symmetry& symmetry) {
  add_integer(print, static_cast<int>(symmetry.kind));
  print.add_numbers(symmetry.point);
  print.add_numbers(symmetry.axis);
  add_integer(print, symmetry.order);
}

void add(Fingerprint& print, const Part& part) {
  print.add(part.name);
  add_count(print, part.primitive.index());
  print.add_numbers(control_points(part.primitive));
  if (const auto* cylinder = std::get_if<GeneralizedCylinder>(&part.primitive)) {
    print.add_numbers(cylinder->radii);
    print.add_numbers(cylinder->rotation.coeffs());
    add_integer(print, cylinder->closed ? 1 : 0);
  }
}

void add(Fingerprint& print, const StructuredShape& rest) {
  print.add_numbers(rest.shape.vertices);
  print.add_numbers(rest.shape.triangles);
  add_integers(print, {rest.shape.triangle_part.begin(), rest.shape.triangle_part.end()});
  for (const Part& part : rest.structure.parts) add(print, part);
  for (const Symmetry& symmetry : rest.structure.symmetries) add(print, symmetry);
  for (const Relation& relation : rest.structure.relations) {
    add_integer(print, static_cast<int>(relation.type));
    add_integers(print, relation.parts);
    add(print, relation.symmetry);
    print.add_numbers(relation.points);
  }
}

void add(Fingerprint& print, const Requirements& requirements) {
  print.add(requirements.target);
  add_integer(print, requirements.length_limit ? requirements.length_limit->copies : 0);
  if (requirements.length_limit) print.add(requirements.length_limit->length);
  add_integer(print, static_cast<int>(requirements.measure.semantics));
  add_integer(print, static_cast<int>(requirements.measure.boxes));
  add_integer(print, requirements.keep_height ? 1 : 0);
  add_integers(print, requirements.kept_parts);
  add_integers(print, requirements.editable_parts);
  print.add(requirements.min_size_ratio);
  add_optional(print, requirements.box_tolerance);
  add_optional(print, requirements.min_thickness);
  print.add(requirements.measure.clearance);
  print.add(requirements.measure.play);
  add_optional(print, requirements.min_draft_degrees);
  add_integer(print, requirements.standing_copies.value_or(0));
  print.add(requirements.min_tipping_degrees);
  add_optional(print, requirements.friction);
  add_integer(print, requirements.resting_part.value_or(-1));
  print.add(requirements.min_air_elsewhere);
}

void add(Fingerprint& print, const ContactEditOptions& options) {
  add_integer(print, static_cast<int>(options.family));
  add_integer(print, options.bends ? 1 : 0);
  print.add(options.move_step);
  print.add(options.scale_step);
  add_count(print, options.multiples.size());
  for (const double multiple : options.multiples) print.add(multiple);
  add_integer(print, options.max_regions);
  print.add(options.contacts.band);
  print.add(options.contacts.line_aspect);
  print.add(options.contacts.min_hole);
  add_count(print, static_cast<std::size_t>(options.contacts.max_pairs));
}

}  // namespace

std::uint64_t task_fingerprint(const RequirementChecker& checker, const BestFirstOptions& options) {
  Fingerprint print;
  add_integer(print, static_cast<int>(checker.space().kind()));
  add_integer(print, static_cast<int>(checker.space().following()));
  add(print, checker.space().rest());
  add(print, checker.requirements());
  print.add(options.alpha);
  add(print, options.edits);
  add_integer(print, options.solutions);
  print.add(options.cone_degrees);
  add_count(print, options.directions.size());
  for (const Eigen::Vector3d& direction : options.directions) print.add_numbers(direction);
  return print.value();
}

}  // namespace stackabilization::detail
