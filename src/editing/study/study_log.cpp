#include <charconv>
#include <cmath>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/number_text.h"
#include "stackabilization/editing/study.h"

namespace stackabilization::editing {

namespace {

/// A field as CSV has it (RFC 4180): within quotes where it needs them.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
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

}  // namespace

std::string study_heading() {
  return "participant,turn,task,condition,seconds,event,edit,target,stackability,reached,distortion_volume,"
         "distortion_proximity,distortion_box,distortion_symmetry,change,edits,nearest_limit,share_of_limit,"
         "answer_1,answer_2,answer_3\n";
}

std::string study_row(const StudyEntry& entry, const QualityLimits& limits) {
  const Distortion& distortion = entry.energy.distortion;
  const auto [limit, share] = nearest_limit(entry.assessment, limits);
  std::string row = std::to_string(entry.participant) + "," + std::to_string(entry.turn) + "," +
                    field(entry.task) + "," + name_of(entry.condition) + "," +
                    shortest_text(std::round(10 * entry.seconds) / 10) + "," + entry.event + "," +
                    field(entry.edit);
  for (const double value : {entry.target, entry.assessment.measured.value})
    row += "," + shortest_text(value);
  row += reaches_target(entry.assessment) ? ",true" : ",false";
  for (const double value :
       {distortion.volume, distortion.proximity, distortion.box, distortion.symmetry, entry.change})
    row += "," + shortest_text(value);
  row += "," + std::to_string(entry.edits) + "," + limit + "," + shortest_text(share);
  for (const int answer : entry.answers) row += answer == 0 ? "," : "," + std::to_string(answer);
  return row + "\n";
}

int last_participant(std::string_view csv, const std::string& name) {
  const std::string heading = study_heading();
  if (csv.substr(0, heading.size()) != heading)
    throw InputError(name +
                     ", line 1: expected the columns of a study: " + heading.substr(0, heading.size() - 1));
  int last = 0, line = 1;
  for (std::size_t at = heading.size(); at < csv.size();) {
    ++line;
    const std::size_t end = std::min(csv.find('\n', at), csv.size());
    const std::string_view row = csv.substr(at, end - at);
    int participant = 0;
    const auto [rest, error] = std::from_chars(row.data(), row.data() + row.size(), participant);
    if (error != std::errc() || rest == row.data() + row.size() || *rest != ',' || participant < 1)
      throw InputError(name + ", line " + std::to_string(line) + ": expected the number of a participant");
    last = std::max(last, participant);
    at = end + 1;
  }
  return last;
}

}  // namespace stackabilization::editing
