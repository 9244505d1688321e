#include <algorithm>
#include <array>
#include <vector>

#include "stackabilization/core/number_text.h"
#include "stackabilization/stacking/validation.h"

namespace stackabilization {

namespace {

constexpr std::size_t column_count = 6;
using TableLine = std::array<std::string, column_count>;

TableLine line_of(const ValidationRow& row) {
  constexpr int round_trip = 17, milliseconds = 3;
  return {row.name,
          row.value ? significant_text(*row.value, round_trip) : "",
          row.error ? scientific_text(*row.error, 1) : "",
          fixed_text(row.seconds, milliseconds),
          to_string(row.verdict),
          row.note};
}

}  // namespace

std::string to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::agrees:
      return "agrees";
    case Verdict::within_sampling:
      return "within sampling";
    case Verdict::skipped:
      return "skipped";
    case Verdict::disagrees:
      break;
  }
  return "DISAGREES";
}

std::string table(const ValidationReport& report) {
  std::vector<TableLine> lines = {{"check", "value", "error / h", "seconds", "verdict", "note"}};
  for (const ValidationRow& row : report.rows) lines.push_back(line_of(row));
  std::array<std::size_t, column_count> width = {};
  for (const TableLine& line : lines)
    for (std::size_t c = 0; c < column_count; ++c) width[c] = std::max(width[c], line[c].size());

  std::string text;
  for (const TableLine& line : lines) {
    std::string row;
    for (std::size_t c = 0; c < column_count; ++c) {
      const std::string padding(width[c] - line[c].size(), ' ');
      const bool to_the_right = c >= 1 && c <= 3;
      row += (c == 0 ? "" : "  ") + (to_the_right ? padding + line[c] : line[c] + padding);
    }
    text += row.substr(0, row.find_last_not_of(' ') + 1) + "\n";
  }
  const auto against = std::count_if(report.rows.begin(), report.rows.end(), [](const ValidationRow& row) {
    return row.verdict == Verdict::disagrees;
  });
  return text + (report.passed ? "every check agrees with the exact value\n"
                               : std::to_string(against) + " of " + std::to_string(report.rows.size()) +
                                     " checks DISAGREE with the exact value\n");
}

}  // namespace stackabilization
