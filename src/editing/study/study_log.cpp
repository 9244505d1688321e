#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/number_text.h"
#include "stackabilization/editing/study.h"

namespace stackabilization::editing {

namespace {

/// A field as CSV has it (RFC 4180): within quotes where it needs them. Precondition: no line ends.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char letter : text) quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return quoted + "\"";
}

/// The measure of quality that is nearest to its limit, and the share of the limit that it uses.
std::pair<std::string, double> nearest_limit(const Assessment& assessment, const QualityLimits& limits) {
  std::pair<std::string, double> nearest = {"", 0};
  for (const Check& check : assessment.checks) {
    if (check.kind != CheckKind::quality || !limits.is_limited(check.measure)) continue;
    const double share = share_of_limit({check.measure, check.value, check.where, check.other}, limits);
    if (share > nearest.second) nearest = {name_of(check.measure), share};
  }
  return nearest;
}

bool reaches_target(const Assessment& assessment) {
  for (const Check& check : assessment.checks)
    if (!check.passed) return false;
  return true;
}

// Columns of `study_heading`.
constexpr std::size_t participant_column = 0, task_column = 2, condition_column = 3, seconds_column = 4,
                      event_column = 5, target_column = 7, reached_column = 9, answer_column = 18,
                      column_count = 21;

/// A row of a CSV of studies, with its place.
struct Row {
  std::vector<std::string> fields;
  std::string place;

  [[noreturn]] void fail(std::size_t column, const std::string& expected) const {
    throw InputError(place + ": expected " + expected + " in column " + std::to_string(column + 1) +
                     ", found '" + fields[column] + "'");
  }
  const std::string& text(std::size_t column) const { return fields[column]; }
  double number(std::size_t column) const {
    const std::string& field = fields[column];
    double value = 0;
    const auto [rest, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || rest != field.data() + field.size() || !std::isfinite(value))
      fail(column, "a number");
    return value;
  }
  int whole(std::size_t column, int least) const {
    const double value = number(column);
    if (value < least || value > 1e9 || value != std::floor(value)) fail(column, "a whole number");
    return static_cast<int>(value);
  }
  StudyCondition condition() const {
    for (const StudyCondition one :
         {StudyCondition::manual, StudyCondition::suggestive, StudyCondition::automatic})
      if (fields[condition_column] == name_of(one)) return one;
    fail(condition_column, "manual, suggestive or automatic");
  }
};

std::vector<std::string> fields_of(std::string_view row) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t k = 0; k < row.size(); ++k) {
    const bool twice = quoted && row.substr(k, 2) == "\"\"";
    if (row[k] == '"' && !twice)
      quoted = !quoted;
    else if (row[k] == ',' && !quoted)
      fields.emplace_back();
    else
      fields.back() += row[k];
    if (twice) ++k;
  }
  return fields;
}

/// Rows after the heading. Names of tasks and edits have no line ends.
std::vector<Row> rows_of(std::string_view csv, const std::string& name) {
  const std::string heading = study_heading();
  if (csv.substr(0, heading.size()) != heading)
    throw InputError(name +
                     ", line 1: expected the columns of a study: " + heading.substr(0, heading.size() - 1));
  std::vector<Row> rows;
  for (std::size_t at = heading.size(); at < csv.size();) {
    const std::size_t end = std::min(csv.find('\n', at), csv.size());
    rows.push_back({fields_of(csv.substr(at, end - at)), name + ", line " + std::to_string(rows.size() + 2)});
    if (rows.back().fields.size() != column_count)
      throw InputError(rows.back().place + ": expected " + std::to_string(column_count) + " columns, found " +
                       std::to_string(rows.back().fields.size()));
    at = end + 1;
  }
  return rows;
}

}  // namespace

std::string study_heading() {
  return "participant,turn,task,condition,seconds,event,edit,target,stackability,reached,distortion_volume,"
         "distortion_proximity,distortion_box,distortion_symmetry,change,edits,nearest_limit,share_of_limit,"
         "answer_1,answer_2,answer_3\n";
}

std::string study_row(const StudyEntry& entry, const QualityLimits& limits) {
  const Distortion& distortion = entry.energy.distortion;
  const auto [limit, share] = nearest_limit(entry.assessment, limits);
  std::vector<std::string> row = {std::to_string(entry.participant),
                                  std::to_string(entry.turn),
                                  field(entry.task),
                                  name_of(entry.condition),
                                  shortest_text(std::round(10 * entry.seconds) / 10),
                                  entry.event,
                                  field(entry.edit),
                                  shortest_text(entry.target),
                                  shortest_text(entry.assessment.measured.value),
                                  reaches_target(entry.assessment) ? "true" : "false",
                                  shortest_text(distortion.volume),
                                  shortest_text(distortion.proximity),
                                  shortest_text(distortion.box),
                                  shortest_text(distortion.symmetry),
                                  shortest_text(entry.change),
                                  std::to_string(entry.edits),
                                  limit,
                                  shortest_text(share)};
  for (const int answer : entry.answers) row.push_back(answer == 0 ? "" : std::to_string(answer));
  std::string line;
  for (const std::string& value : row) line.append(line.empty() ? "" : ",").append(value);
  return line.append("\n");
}

int last_participant(std::string_view csv, const std::string& name) {
  int last = 0;
  for (const Row& row : rows_of(csv, name)) last = std::max(last, row.whole(participant_column, 1));
  return last;
}

std::vector<StudyResult> study_results(std::string_view csv, const std::string& name) {
  std::vector<StudyResult> results;
  std::map<std::pair<int, std::string>, int> made;
  for (const Row& row : rows_of(csv, name)) {
    StudyResult result;
    result.participant = row.whole(participant_column, 1);
    result.task = row.text(task_column);
    const std::string& event = row.text(event_column);
    int& edits = made[{result.participant, result.task}];
    if (event == "begin") edits = 0;
    if (event == "edit") ++edits;
    if (event != "done" && event != "give up") continue;
    result.condition = row.condition();
    result.seconds = row.number(seconds_column);
    result.target = row.number(target_column);
    result.stackability = row.number(target_column + 1);
    result.reached = row.text(reached_column) == "true";
    result.distortion = {row.number(reached_column + 1), row.number(reached_column + 2),
                         row.number(reached_column + 3), row.number(reached_column + 4)};
    result.change = row.number(reached_column + 5);
    result.edits = row.whole(reached_column + 6, 0);
    for (std::size_t k = 0; k < result.answers.size(); ++k)
      result.answers[k] = row.whole(answer_column + k, 1);
    result.made = edits;
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace stackabilization::editing
