#include "apps/improve/improve_report.h"

#include <algorithm>
#include <cmath>

#include "apps/common/explanation_report.h"
#include "apps/common/text.h"
#include "stackabilization/core/direction_text.h"

namespace stackabilization::apps {

namespace {

std::string part_list(const std::vector<int>& parts, const StructuredShape& rest) {
  std::vector<std::string> names;
  for (const int part : parts) names.push_back(rest.shape.part_names.at(static_cast<std::size_t>(part)));
  return joined(names);
}

/// What every part and the air between copies have to respect.
void add_requirement_lines(std::vector<std::string>& lines, const ImproveReport& report) {
  const Requirements& asked = report.task.checker().requirements();
  const StructuredShape& rest = report.task.rest();
  const Unit unit = rest.shape.unit;
  if (asked.keep_height) lines.emplace_back("the height along the direction stays what it is");
  if (!report.options.removed.empty()) lines.push_back("left out first: " + joined(report.options.removed));
  if (!asked.kept_parts.empty()) lines.push_back("stays as it is: " + part_list(asked.kept_parts, rest));
  if (!asked.editable_parts.empty())
    lines.push_back("only this may change: " + part_list(asked.editable_parts, rest));
  if (asked.box_tolerance)
    lines.push_back("sides of the box change by at most " + percent(*asked.box_tolerance));
  if (asked.min_thickness)
    lines.push_back("walls no thinner than " + quantity(*asked.min_thickness, unit) + ", or than they are");
  if (asked.measure.clearance > 0)
    lines.push_back("air between copies: " + quantity(asked.measure.clearance, unit));
  if (asked.measure.play > 0) lines.push_back("sideways play: " + quantity(asked.measure.play, unit));
  if (asked.min_draft_degrees)
    lines.push_back("draft at the contacts: at least " + rounded(*asked.min_draft_degrees) + " degrees");
  if (asked.standing_copies)
    lines.push_back("a stack of " + std::to_string(*asked.standing_copies) +
                    " stands, on ground tilted by up to " + rounded(asked.min_tipping_degrees) + " degrees");
  if (asked.friction) lines.push_back("copies do not jam with friction " + rounded(*asked.friction));
  if (asked.resting_part)
    lines.push_back("copies rest on " + part_list({*asked.resting_part}, rest) + ", and keep " +
                    percent(asked.min_air_elsewhere) + " of the height away from other parts");
}

void add_solution_rows(ColumnTable& table, const SolutionReport& solution) {
  const std::vector<std::string> words = explanation_lines(solution.explanation);
  const std::string change = percent(solution.change.root_mean_square);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) {
      table.add({"", "", "", "", "", "", words[i]});
      continue;
    }
    table.add({solution.name, stackability_text(solution.assessment.measured.value),
               direction_text(solution.candidate.direction),
               stackability_text(solution.candidate.energy.distortion.total()),
               stackability_text(solution.candidate.energy.value), change, words[i]});
  }
}

/// Requirements that a solution misses, and checks that contradict it.
std::string complaints(const ImproveReport& report) {
  std::string text;
  for (const SolutionReport* solution : report.shown()) {
    for (const Confirmation& check : solution->written)
      if (check.verdict == Verdict::disagrees)
        text += solution->name + ".obj does NOT confirm this: " + check.name + ": " + check.note + "\n";
    if (!report.solutions.empty() && !solution->stack.fits())
      text += solution->name + ": " + saving_text(solution->stack, report.task.rest().shape.unit) +
              ", which does NOT fit " + quantity(*solution->stack.room, report.task.rest().shape.unit) + "\n";
  }
  return text;
}

}  // namespace

bool ImproveReport::reached() const {
  const auto confirmed = [](const SolutionReport& solution) { return solution.confirmed(); };
  const auto good = [](const SolutionReport& solution) { return solution.good(); };
  const bool missed = run.front && options.target && !run.front->reached;
  return !missed && std::all_of(solutions.begin(), solutions.end(), confirmed) &&
         std::any_of(solutions.begin(), solutions.end(), good);
}

const Diagnosis* ImproveReport::diagnosis() const {
  return run.result.diagnosis && !(run.front && reached()) ? &*run.result.diagnosis : nullptr;
}

std::vector<const SolutionReport*> ImproveReport::shown() const {
  std::vector<const SolutionReport*> list;
  for (const SolutionReport& solution : solutions) list.push_back(&solution);
  if (nearest) list.push_back(&*nearest);
  return list;
}

std::vector<FrontRow> front_rows(const ImproveReport& report) {
  std::vector<FrontRow> rows;
  if (!report.run.front) return rows;
  for (std::size_t k = 0; k < report.run.front->points.size(); ++k) {
    const SolutionReport* const solution = k == 0 ? nullptr : &report.solutions.at(k - 1);
    rows.push_back(
        {report.run.front->points[k], solution,
         solution != nullptr ? explanation_lines(solution->explanation) : std::vector<std::string>()});
  }
  return rows;
}

std::string front_table(const ImproveReport& report) {
  std::string text = "target,stackability,change,f_max,edits,name,words\n";
  for (const FrontRow& row : front_rows(report)) {
    const Stackability& measured = row.point.assessment.measured;
    for (const double number : {row.point.target, measured.value, row.point.change, measured.f_max})
      text += exact_digits(number) + ",";
    // Part names are in the words.
    std::string words = joined(row.lines, "; ");
    for (std::size_t at = words.find('"'); at != std::string::npos; at = words.find('"', at + 2))
      words.insert(at, 1, '"');
    text += std::to_string(row.point.candidate.design.edits.size()) + "," +
            (row.solution != nullptr ? row.solution->name : "") + ",\"" + words + "\"\n";
  }
  return text;
}

std::string title_of(const SolutionReport& solution) {
  if (solution.name == "nearest") return "Nearest";
  return "Solution " + solution.name.substr(solution.name.find('_') + 1);
}

std::vector<std::string> wish_lines(const ImproveReport& report) {
  const ImproveTask& task = report.task;
  std::string directions;
  for (const Eigen::Vector3d& direction : task.task->directions())
    directions += (directions.empty() ? "" : " or ") + direction_text(direction);
  std::vector<std::string> lines;
  if (task.length_limit())
    lines.push_back(std::to_string(*report.options.room.copies) + " copies within " +
                    quantity(*task.length_limit(), task.rest().shape.unit));
  const BoxModel boxes = task.checker().requirements().measure.boxes;
  const std::string goal = report.options.front && !report.options.target
                               ? "as much S as can be reached"
                               : "S of at least " + rounded(task.target());
  lines.push_back((report.options.front ? "designs from rest to " : "") + goal + " " + directions + " (" +
                  (boxes == BoxModel::frame ? "frame" : "oriented") + " boxes)");
  add_requirement_lines(lines, report);
  return lines;
}

std::string end_text(const ImproveRun& run) {
  if (run.running) return "the search had not ended when this was written";
  switch (run.result.end) {
    case SearchEnd::solved:
      return "all solutions that were asked for are found";
    case SearchEnd::exhausted:
      return "there is nothing left to try";
    case SearchEnd::expansion_limit:
      return "stopped after the candidates of --expansions; --resume goes on with more";
    case SearchEnd::trial_limit:
      return "stopped after the work of --effort " + rounded(run.options.effort) +
             "; --resume goes on with a larger one";
    case SearchEnd::time_limit:
      return "stopped after the seconds of --time; --resume goes on";
    case SearchEnd::cancelled:
      return "interrupted; --resume goes on";
  }
  return "";
}

std::string improvement_text(const ImproveReport& report) {
  const ImproveTask& task = report.task;
  const Improvement& result = report.run.result;
  TextTable head;
  add_model_line(head, task.model);
  const std::vector<std::string> wishes = wish_lines(report);
  for (std::size_t i = 0; i < wishes.size(); ++i) head.add(i == 0 ? "Asked for" : "", wishes[i]);
  head.add("Search", counted(result.progress.evaluated, "design") + " measured, " + end_text(report.run));
  ColumnTable table({"", "S", "direction", "D", "E", "change", "what changes"});
  for (const SolutionReport* solution : report.shown()) add_solution_rows(table, *solution);
  std::string text = head.text();
  if (!table.empty()) text += "\n" + table.text();
  text += "\n" + complaints(report);
  if (report.reached())
    text += "Reached: " + counted(static_cast<long long>(report.solutions.size()), "solution") + ". " +
            saving_text(report.solutions.front().stack, task.rest().shape.unit) + "." +
            lean_text(report.solutions.front().assessment.measured, report.solutions.front().stack.copies,
                      task.rest().shape.unit) +
            "\n" +
            (report.solutions.front().holding
                 ? holding_text(*report.solutions.front().holding, task.rest().shape.part_names) + "\n"
                 : "");
  else if (report.solutions.empty())
    text += "Not reached.\n";
  if (const Diagnosis* const diagnosis = report.diagnosis())
    text += stackabilization::text(*diagnosis, task.rest().structure);
  if (!text.ends_with('\n')) text += '\n';
  if (!report.pictures_missing.empty()) text += "No pictures: " + report.pictures_missing + ".\n";
  return text + "Written to " + report.options.folder + ": open index.html there in a browser.\n";
}

}  // namespace stackabilization::apps
