#include <algorithm>
#include <array>
#include <charconv>
#include <vector>

#include "stackabilization/stacking/validation.h"

namespace stackabilization {

namespace {

constexpr std::size_t columns = 6;
using Line = std::array<std::string, columns>;

std::string number(double value, std::chars_format format, int digits) {
  char text[64];
  const auto end = std::to_chars(text, text + sizeof text, value, format, digits).ptr;
  return {text, end};
}

Line line_of(const ValidationRow& row) {
  constexpr int round_trip = 17, milliseconds = 3;
  return {row.name,
          row.value ? number(*row.value, std::chars_format::general, round_trip) : "",
          row.error ? number(*row.error, std::chars_format::scientific, 1) : "",
          number(row.seconds, std::chars_format::fixed, milliseconds),
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
  std::vector<Line> lines = {{"check", "value", "error / h", "seconds", "verdict", "note"}};
  for (const ValidationRow& row : report.rows) lines.push_back(line_of(row));
  std::array<std::size_t, columns> width = {};
  for (const Line& line : lines)
    for (std::size_t c = 0; c < columns; ++c) width[c] = std::max(width[c], line[c].size());

  std::string text;
  for (const Line& line : lines) {
    std::string row;
    for (std::size_t c = 0; c < columns; ++c) {
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
