#include "apps/common/text.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "stackabilization/core/number_text.h"
#include "stackabilization/stacking/tolerances.h"

namespace stackabilization::apps {

namespace {

constexpr int readable_digits = 5;
constexpr double negligible = 1e-6;       ///< fraction of a size that a reader takes for nothing
constexpr std::size_t widest_value = 28;  ///< longer values push their explanation to the right alone

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(text.size() < width ? width - text.size() : 0, ' ');
}

}  // namespace

std::string rounded(double value) {
  return significant_text(value, readable_digits);
}

std::string exact_digits(double value) {
  return shortest_text(value);
}

std::string quantity(double value, Unit unit, int power) {
  const std::string symbol = unit_symbol(unit);
  if (symbol.empty()) return rounded(value);
  std::string text = rounded(value) + " " + symbol;
  if (power != 1) text.append("^").append(std::to_string(power));
  return text;
}

std::string stackability_text(double value) {
  return rounded(std::abs(value) < tolerance::stackability ? 0 : value);
}

std::string percent(double fraction) {
  return fixed_text(100 * fraction, 1) + " %";
}

std::string small_percent(double fraction) {
  const double value = 100 * fraction;
  return (value < 100 ? significant_text(value, 2) : fixed_text(value, 0)) + " %";
}

std::string degrees_text(double degrees) {
  return rounded(degrees) + (degrees == 1 ? " degree" : " degrees");
}

std::string vector_text(const Eigen::Vector3d& vector) {
  return exact_digits(vector.x()) + " " + exact_digits(vector.y()) + " " + exact_digits(vector.z());
}

std::string point_text(const Eigen::Vector3d& point) {
  std::string text = "(";
  return text.append(rounded(point.x()) + ", " + rounded(point.y()) + ", " + rounded(point.z()) + ")");
}

std::string point_text(const Eigen::Vector3d& point, double size) {
  const double least = size * negligible;
  return point_text(point.unaryExpr([least](double x) { return std::abs(x) < least ? 0 : x; }));
}

std::string joined(const std::vector<std::string>& texts, const std::string& between) {
  std::string text;
  for (const std::string& next : texts) text += (text.empty() ? "" : between) + next;
  return text;
}

std::string counted(long long count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

void TextTable::add(std::string label, std::string value, std::string explanation) {
  rows_.push_back({std::move(label), std::move(value), std::move(explanation)});
}

std::string TextTable::text() const {
  std::size_t labels = 0, values = 0;
  for (const Row& row : rows_) {
    labels = std::max(labels, row.label.size());
    if (!row.explanation.empty()) values = std::max(values, std::min(row.value.size(), widest_value));
  }
  std::string lines;
  for (const Row& row : rows_) {
    lines += padded(row.label, labels) + "  ";
    lines += row.explanation.empty() ? row.value : padded(row.value, values) + "  " + row.explanation;
    lines += '\n';
  }
  return lines;
}

std::string ColumnTable::text() const {
  std::vector<std::size_t> widths(rows_.front().size());
  for (const std::vector<std::string>& row : rows_)
    for (std::size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string lines;
  for (const std::vector<std::string>& row : rows_) {
    std::string line;
    for (std::size_t i = 0; i < widths.size(); ++i) line += padded(row[i], widths[i]) + "  ";
    lines += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  }
  return lines;
}

}  // namespace stackabilization::apps
