#include <algorithm>

#include "apps/common/design_json.h"
#include "apps/common/edit_grammar.h"
#include "apps/common/explanation_report.h"
#include "apps/common/measurement.h"
#include "apps/common/structure_report.h"
#include "apps/improve/improve_report.h"
#include "stackabilization/improvement/history.h"

namespace stackabilization::apps {

namespace {

const char* search_end_name(const ImproveRun& run) {
  if (run.running) return "running";
  switch (run.result.end) {
    case SearchEnd::solved:
      return "solved";
    case SearchEnd::exhausted:
      return "exhausted";
    case SearchEnd::expansion_limit:
      return "expansion limit";
    case SearchEnd::trial_limit:
      return "effort";
    case SearchEnd::time_limit:
      return "time limit";
    case SearchEnd::cancelled:
      return "interrupted";
  }
  return "";
}

const char* change_measure_name(ChangeMeasure measure) {
  switch (measure) {
    case ChangeMeasure::distortion:
      return "distortion";
    case ChangeMeasure::displacement:
      return "displacement";
    case ChangeMeasure::both:
      return "both";
  }
  return "";
}

Json edits_json(const ImproveTask& task, const Candidate& candidate) {
  Json list = Json::array();
  const std::vector<Edit>& edits = candidate.design.edits;
  for (std::size_t i = 0; i < edits.size(); ++i) {
    // Refinement may merge edits; then reasons and edits no longer go together.
    const bool known = candidate.reasons.size() == edits.size();
    const std::vector<std::string>& names = task.rest().shape.part_names;
    Json document = {{"text", edit_text(edits[i], names)},
                     {"words", describe(edits[i], names)},
                     {"reason", known ? describe(candidate.reasons[i], names) : ""}};
    document.update(Json::parse(edit_json(edits[i], names)));
    list.push_back(std::move(document));
  }
  return list;
}

Json stackability_json(const Stackability& measured) {
  return {{"direction", to_json(measured.direction)},
          {"stackability", measured.value},
          {"f_max", measured.f_max},
          {"height", measured.extent},
          {"box_volume", measured.box_volume},
          {"stack_box_volume", measured.stack_box_volume()}};
}

Json requirements_json(const Assessment& assessment, const Structure& rest) {
  Json list = Json::array();
  for (const Check& check : assessment.checks)
    list.push_back({{"name", name_of(check)},
                    {"value", check.value},
                    {"demanded", check.demanded},
                    {"unit", unit_of(check)},
                    {"passed", check.passed},
                    {"note", note_of(check, rest)}});
  return list;
}

Json checks_json(const SolutionReport& solution) {
  Json list = Json::array();
  for (const Confirmation& check : solution.written) {
    const std::string verdict = check.verdict == Verdict::disagrees ? "disagrees" : to_string(check.verdict);
    list.push_back({{"name", check.name}, {"verdict", verdict}, {"note", check.note}});
  }
  return list;
}

Json residuals_json(const Structure& structure, const std::vector<double>& residuals) {
  Json list = Json::array();
  for (std::size_t i = 0; i < residuals.size(); ++i)
    list.push_back({{"relation", describe(structure.relations[i], structure)}, {"residual", residuals[i]}});
  return list;
}

Json stack_json(const SolutionReport& solution) {
  const StackHeights& stack = solution.stack;
  Json document = {{"copies", stack.copies},
                   {"height_before", stack.before},
                   {"height", stack.after},
                   {"saving", 1 - stack.after / stack.before},
                   {"drift", solution.assessment.measured.stack_drift(stack.copies)},
                   {"within", to_json(stack.room)},
                   {"fits", stack.fits()}};
  if (solution.twist)
    document["twist"] = {{"degrees", solution.twist->twist_degrees},
                         {"stackability", solution.twist->stack.stackability},
                         {"height", solution.twist->stack.height},
                         {"untwisted_stackability", solution.twist->untwisted_stackability}};
  return document;
}

Json parts_json(const std::vector<int>& parts, const StructuredShape& rest) {
  Json list = Json::array();
  for (const int part : parts)
    list.push_back(part < 0 ? Json(nullptr) : Json(rest.shape.part_names.at(static_cast<std::size_t>(part))));
  return list;
}

Json closed_json(const std::optional<ClosedPair>& pair, const StructuredShape& rest) {
  if (!pair) return nullptr;
  return {{"parts", parts_json({pair->upper_part, pair->lower_part}, rest)},
          {"stackability", pair->stackability},
          {"reason", describe(*pair, rest.structure)}};
}

Json diagnosis_json(const Diagnosis& diagnosis, const StructuredShape& rest) {
  Json blockers = Json::array(), constraints = Json::array(), remedies = Json::array();
  for (const Blocker& blocker : diagnosis.blockers)
    blockers.push_back({{"parts", parts_json({blocker.upper_part, blocker.lower_part}, rest)},
                        {"type", name_of(blocker.type)},
                        {"f", blocker.f},
                        {"stackability", blocker.stackability},
                        {"reason", reason_of(blocker, rest.structure)}});
  for (const ObstacleCount& constraint : diagnosis.constraints)
    constraints.push_back(describe(constraint, rest.structure));
  for (const Remedy& remedy : diagnosis.remedies) {
    const bool turns = remedy.kind == Remedy::Kind::other_direction;
    Json pieces = Json::array();
    for (const Piece& piece : remedy.pieces)
      pieces.push_back({{"parts", parts_json(piece.parts, rest)},
                        {"direction", to_json(piece.direction)},
                        {"stackability", piece.stackability}});
    remedies.push_back({{"what", describe(remedy, rest.structure)},
                        {"parts", parts_json(remedy.parts, rest)},
                        {"direction", turns ? to_json(remedy.direction) : Json(nullptr)},
                        {"stackability", remedy.stackability},
                        {"pieces", pieces}});
  }
  return {{"target", diagnosis.target},
          {"reached", diagnosis.reached},
          {"direction", to_json(diagnosis.direction)},
          {"closed", closed_json(diagnosis.closed, rest)},
          {"blockers", blockers},
          {"constraints", constraints},
          {"remedies", remedies},
          {"text", text(diagnosis, rest.structure)}};
}

Json target_json(const ImproveReport& report) {
  const ImproveTask& task = report.task;
  Json directions = Json::array();
  for (const Eigen::Vector3d& direction : task.task->directions()) directions.push_back(to_json(direction));
  const StackabilityOptions& measure = task.checker().requirements().measure;
  return {{"stackability", task.target()},
          {"copies", to_json(report.options.room.copies)},
          {"within", to_json(task.length_limit())},
          {"directions", directions},
          {"semantics", name_of(measure.semantics)},
          {"boxes", name_of(measure.boxes)},
          {"deformation", name_of(task.task->space().kind())},
          {"preset", report.options.preset == ImprovementPreset::paper ? "paper" : "refined"},
          {"least", change_measure_name(report.options.objective)},
          {"words", wish_lines(report)}};
}

}  // namespace

Json solution_json(const ImproveReport& report, const SolutionReport& solution) {
  const ImproveTask& task = report.task;
  const Stackability& after = solution.assessment.measured;
  const Separation& exact = solution.assessment.separation;
  return {{"name", solution.name},
          {"direction", to_json(solution.candidate.direction)},
          {"target", solution.target},
          {"stackability", after.value},
          {"stackability_before", solution.before.value},
          {"f_max", exact.blocked ? exact.length : 0},
          {"f_max_exact", to_json(exact.blocked ? exact.value : Rational())},
          {"height", after.extent},
          {"energy", to_json(solution.candidate.energy, report.run.options.search.alpha)},
          {"explanation", explanation_json(solution.explanation, task.rest().shape.part_names)},
          {"edits", edits_json(task, solution.candidate)},
          {"change",
           {{"root_mean_square", solution.change.root_mean_square}, {"largest", solution.change.largest}}},
          {"before", stackability_json(solution.before)},
          {"after", stackability_json(after)},
          {"stack", stack_json(solution)},
          {"holding",
           solution.holding ? to_json(*solution.holding, task.rest().shape.part_names) : Json(nullptr)},
          {"requirements", requirements_json(solution.assessment, task.rest().structure)},
          {"relations", residuals_json(task.rest().structure, solution.residuals)},
          {"checks", checks_json(solution)},
          {"good", solution.good()}};
}

Json front_json(const ImproveReport& report) {
  if (!report.run.front) return nullptr;
  Json list = Json::array();
  for (const FrontRow& row : front_rows(report))
    list.push_back({{"name", row.solution != nullptr ? Json(row.solution->name) : Json(nullptr)},
                    {"target", row.point.target},
                    {"stackability", row.point.assessment.measured.value},
                    {"change", row.point.change},
                    {"f_max", row.point.assessment.measured.f_max},
                    {"edits", row.point.candidate.design.edits.size()},
                    {"lines", row.lines}});
  return list;
}

void add_improvement(Json& document, const ImproveReport& report) {
  const Improvement& result = report.run.result;
  document["target"] = target_json(report);
  document["reached"] = report.reached();
  document["solutions"] = Json::array();
  for (const SolutionReport& solution : report.solutions)
    document["solutions"].push_back(solution_json(report, solution));
  document["nearest"] = report.nearest ? solution_json(report, *report.nearest) : Json(nullptr);
  document["front"] = front_json(report);
  document["diagnosis"] =
      result.diagnosis ? diagnosis_json(*result.diagnosis, report.task.rest()) : Json(nullptr);
  document["search"] = {{"end", search_end_name(report.run)},
                        {"expanded", result.progress.expanded},
                        {"evaluated", result.progress.evaluated},
                        {"queued", result.progress.queued}};
  document["pictures_missing"] =
      report.pictures_missing.empty() ? Json(nullptr) : Json(report.pictures_missing);
}

}  // namespace stackabilization::apps
