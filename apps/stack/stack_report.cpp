#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/common/measurement.h"
#include "apps/common/text.h"
#include "apps/stack/stack_run.h"
#include "stackabilization/core/direction_text.h"

namespace stackabilization::apps {

namespace {

constexpr std::size_t listed_offsets = 6;
constexpr std::size_t listed_conflicts = 3;

/// What takes the model to its place as each copy: x -> rotation x + translation, lift included.
Json copies_json(const StackResult& result, const Direction& direction) {
  Json copies = Json::array();
  for (const StackedCopy& copy : result.copies) {
    const Eigen::Vector3d lift = copy.offset.to_double() * direction.vector();
    copies.push_back({{"rotation", to_json(copy.transform.rotation)},
                      {"translation", to_json(Eigen::Vector3d(copy.transform.translation + lift))},
                      {"rests_on", copy.rests_on < 0 ? Json(nullptr) : Json(copy.rests_on)}});
  }
  return copies;
}

Json conflicts_json(const StackResult& result) {
  Json conflicts = Json::array();
  for (const StackConflict& conflict : result.conflicts)
    conflicts.push_back(
        {{"below", conflict.below}, {"above", conflict.above}, {"overlap", conflict.overlap}});
  return conflicts;
}

Json stack_wish_json(const Wish& wish) {
  const StackPlan& plan = wish.plan;
  return {{"length", wish.length},
          {"met", wish.met},
          {"straight",
           {{"possible", plan.possible},
            {"met", plan.met},
            {"translation", to_json(plan.translation)},
            {"f_max", to_json(plan.f_max)},
            {"stackability", to_json(plan.stackability)},
            {"length_now", plan.length_now},
            {"copies_now", to_json(plan.copies_now)}}}};
}

Json step_json(const StepResult& step) {
  return {{"x", step.shift.x},
          {"y", step.shift.y},
          {"yaw_degrees", step.shift.yaw_degrees},
          {"straight", step.straight},
          {"straight_height", step.straight_height},
          {"second_height", step.second.drop.height},
          {"bound", step.second.bound},
          {"proven", step.second.proven},
          {"cells", step.second.cells},
          {"open_cells", step.second.open}};
}

std::string offsets_text(const StackResult& result, Unit unit) {
  std::string text;
  const std::size_t shown = std::min(result.copies.size(), listed_offsets);
  for (std::size_t i = 0; i < shown; ++i) text += (i ? ", " : "") + rounded(result.copies[i].offset_length);
  if (shown < result.copies.size()) text += ", ...";
  const std::string symbol = unit_symbol(unit);
  return symbol.empty() ? text : text + " " + symbol;
}

void add_step_lines(TextTable& table, const StepResult& step, Unit unit) {
  const BestPlace& second = step.second;
  if (step.straight)
    table.add("Step", "none", "no shift makes the stack lower than straight copies");
  else
    table.add("Step", quantity(step.shift.x, unit) + ", " + quantity(step.shift.y, unit),
              (step.shift.yaw_degrees != 0 ? "and " + rounded(step.shift.yaw_degrees) + " degrees " : "") +
                  "from each copy to the next; straight, the stack is " +
                  quantity(step.straight_height, unit) + " high");
  table.add(second.proven ? "Proven" : "Bound", quantity(second.bound, unit),
            "no place of the second copy is lower; the one found has " + quantity(second.drop.height, unit));
}

void add_pose_lines(TextTable& table, const StackRun& run, Unit unit) {
  if (run.options.twist_degrees != 0 || run.untwisted_stackability)
    table.add("Twist", rounded(run.options.twist_degrees) + " degrees",
              run.untwisted_stackability ? "per copy, the best one found; without it the stackability is " +
                                               stackability_text(*run.untwisted_stackability)
                                         : "per copy");
  if (run.step) add_step_lines(table, *run.step, unit);
  if (run.poses.empty()) return;
  table.add("Poses", joined(run.poses, ", then "));
}

void add_conflict_lines(TextTable& table, const StackRun& run, Unit unit) {
  const std::vector<StackConflict>& conflicts = run.result.conflicts;
  if (conflicts.empty()) return table.add("Conflicts", "none", "it is enough to look at neighbours");
  for (std::size_t i = 0; i < std::min(conflicts.size(), listed_conflicts); ++i)
    table.add(i == 0 ? "Conflicts" : "",
              std::to_string(conflicts[i].below + 1) + " and " + std::to_string(conflicts[i].above + 1),
              "would overlap by " + quantity(conflicts[i].overlap, unit) +
                  " if each copy rested on the one below it");
  if (conflicts.size() > listed_conflicts) table.add("", "...", "all of them with --json");
  table.add("", quantity(run.result.conflict_height, unit), "of the height avoids these conflicts");
}

void add_wish_lines(TextTable& table, const StackRun& run, Unit unit) {
  const Wish& wish = *run.wish;
  const StackPlan& plan = wish.plan;
  table.add("Wish", wish.met ? "met" : "not met",
            std::to_string(run.options.copies) + " within " + quantity(wish.length, unit));
  if (plan.copies_now)
    table.add("", std::to_string(*plan.copies_now),
              "of the shape as it is fit, straight on top of each other");
  if (!plan.possible)
    table.add("", "impossible", "whatever is changed below this height");
  else if (plan.f_max && plan.stackability)
    table.add("", quantity(*plan.f_max, unit),
              "largest f_max that a straight stack may have: a stackability of " +
                  rounded(*plan.stackability) + (run.options.clearance > 0 ? ", air included" : ""));
}

}  // namespace

void add_stack(Json& document, const StackRun& run, const Direction& direction) {
  const StackResult& result = run.result;
  Json offsets = Json::array(), exact_offsets = Json::array();
  for (const StackedCopy& copy : result.copies) {
    offsets.push_back(copy.offset_length);
    exact_offsets.push_back(to_json(copy.offset));
  }
  document["direction"] = to_json(direction.vector());
  document["semantics"] = name_of(run.options.semantics);
  document["boxes"] = name_of(run.options.boxes);
  document["n"] = run.options.copies;
  document["twist_degrees"] = run.options.twist_degrees;
  document["untwisted_stackability"] = to_json(run.untwisted_stackability);
  document["period"] = run.period;
  document["poses"] = run.poses;
  document["step"] = run.step ? step_json(*run.step) : Json(nullptr);
  document["clearance"] = run.options.clearance;
  document["lateral_clearance"] = run.options.play;
  document["layer"] = run.options.layer > 0 ? Json(run.options.layer) : Json(nullptr);
  document["separators"] = run.separators ? Json{{"gaps", run.gap_count()},
                                                 {"regions", run.separators->part_count()},
                                                 {"triangles", run.separators->triangle_count()}}
                                          : Json(nullptr);
  document["offsets"] = std::move(offsets);
  document["exact_offsets"] = std::move(exact_offsets);
  document["copies"] = copies_json(result, direction);
  document["copy_height"] = run.extent;
  document["height"] = result.height;
  document["nesting_increment"] = result.increment;
  document["box_volume"] = result.box_volume;
  document["stack_volume"] = result.stack_volume;
  document["stackability"] = result.stackability;
  document["conflicts"] = conflicts_json(result);
  document["conflict_height"] = result.conflict_height;
  document["within"] = run.wish ? stack_wish_json(*run.wish) : Json(nullptr);
}

std::string stack_text(const StackRun& run, const Model& model, const Direction& direction) {
  const Unit unit = model.shape.unit;
  const StackResult& result = run.result;
  TextTable table;
  add_model_line(table, model);
  table.add("Direction", vector_text(direction.vector()), "copies come from above along it");
  table.add("Copies", std::to_string(run.options.copies), "offsets " + offsets_text(result, unit));
  table.add("Height", quantity(result.height, unit),
            "of the stack; one copy is " + quantity(run.extent, unit));
  if (run.options.layer > 0)
    table.add("Layers", rounded(std::round(result.increment / run.options.layer)),
              "from each copy to the next, " + quantity(run.options.layer, unit) + " each");
  if (run.separators)
    table.add("Separators",
              std::to_string(run.gap_count()) + " x " + std::to_string(run.separators->part_count()),
              run.separators->part_count() > 0 ? "bodies that fill the gaps where they are narrow"
                                               : "the copies are close to each other over no area");
  add_pose_lines(table, run, unit);
  table.add("Boxes", quantity(result.stack_volume, unit, 3),
            "of the stack, and " + quantity(result.box_volume, unit, 3) + " of one copy (" +
                name_of(run.options.boxes) + ")");
  table.add("Stackability", stackability_text(result.stackability) + " " + direction_text(direction.vector()),
            "space saved by this stack: 1 is all of it, 0 none");
  add_conflict_lines(table, run, unit);
  if (run.wish) add_wish_lines(table, run, unit);
  return table.text() + "Each further copy adds " + quantity(result.increment, unit) +
         (unit == Unit::unknown ? " (model units)" : "") +
         " to the stack: " + percent(result.increment / run.extent) + " of the height.\n";
}

std::vector<std::string> stack_notes(const StackRun& run, Unit unit, const Direction& direction) {
  return {std::to_string(run.options.copies) + " copies, " + quantity(run.result.height, unit) + " high",
          "each further copy adds " + quantity(run.result.increment, unit),
          "stackability " + stackability_text(run.result.stackability) + " " +
              direction_text(direction.vector())};
}

}  // namespace stackabilization::apps
