#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "stackabilization/core/shape.h"

/// Numbers and tables for people. Independent of the locale.
namespace stackabilization::apps {

/// Five significant digits: for reading.
std::string rounded(double value);
/// As many digits as bring the double back.
std::string exact_digits(double value);
/// A stackability for reading: 0 where it is known no better than that.
std::string stackability_text(double value);
/// "0.412 m", "0.06 m^3"; without the unit where it is unknown.
std::string quantity(double value, Unit unit, int power = 1);
/// "50.9 %"
std::string percent(double fraction);
/// "0.012 %", two significant digits: for errors.
std::string small_percent(double fraction);
/// "1 degree", "2.5 degrees"
std::string degrees_text(double degrees);
/// "0 0 1", all digits.
std::string vector_text(const Eigen::Vector3d& vector);
/// "(0.1, 0.2, 0.3)", rounded.
std::string point_text(const Eigen::Vector3d& point);
/// The same, with 0 for what is rounding beside lengths of this size.
std::string point_text(const Eigen::Vector3d& point, double size);
/// "seat, leg_1, leg_2"
std::string joined(const std::vector<std::string>& texts, const std::string& between = ", ");
/// "1 region", "4 regions"
std::string counted(long long count, const std::string& noun);

/// Lines of label, value and explanation in columns.
class TextTable {
 public:
  void add(std::string label, std::string value, std::string explanation = "");
  std::string text() const;

 private:
  struct Row {
    std::string label, value, explanation;
  };
  std::vector<Row> rows_;
};

/// Rows of any number of columns below a heading, two blanks between columns.
class ColumnTable {
 public:
  explicit ColumnTable(std::vector<std::string> headings) : rows_{std::move(headings)} {}
  /// As many cells as headings.
  void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  bool empty() const { return rows_.size() == 1; }
  std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace stackabilization::apps
