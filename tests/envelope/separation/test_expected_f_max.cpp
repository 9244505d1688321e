#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <sstream>

#include "stackabilization/envelope/separation.h"
#include "stackabilization/io/read.h"
#include "support/catch.h"

using namespace stackabilization;

namespace {

/// One row of a table made by an independent program in rational arithmetic: file, direction, f_max, h, f_max
/// / h.
struct Expected {
  std::string model;
  double x, y, z, f_max, height, ratio;
};

std::vector<Expected> read_table(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<Expected> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#' || line.rfind("model\t", 0) == 0) continue;
    std::istringstream fields(line);
    Expected row;
    std::getline(fields, row.model, '\t');
    INFO(path << ": " << line);
    REQUIRE(fields >> row.x >> row.y >> row.z >> row.f_max >> row.height >> row.ratio);
    rows.push_back(row);
  }
  return rows;
}

double extent(const Shape& shape, const Direction& direction) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    for (int c = 0; c < 3; ++c) {
      const double height = direction.unit().dot(shape.corner(t, c));
      low = std::min(low, height);
      high = std::max(high, height);
    }
  return high - low;
}

void check_table(const std::filesystem::path& folder, std::size_t row_count) {
  const std::vector<Expected> rows = read_table(folder / "expected_f_max.tsv");
  REQUIRE(rows.size() == row_count);
  std::string last;
  Shape shape;
  std::optional<SeparationTree> tree;
  for (const Expected& row : rows) {
    if (row.model != last) {
      shape = read_shape(folder / row.model);
      tree.emplace(shape);
      last = row.model;
    }
    INFO(row.model << " along " << row.x << " " << row.y << " " << row.z);
    const Direction direction(row.x, row.y, row.z);
    const Separation result = separation(*tree, *tree, direction);
    CHECK(std::abs(result.length / extent(shape, direction) - row.ratio) <= 1e-12);
  }
}

/// Value of an environment variable, or nothing with a line that says what is skipped.
std::optional<std::filesystem::path> data_folder(const char* variable) {
  const char* value = std::getenv(variable);
  if (value != nullptr && *value != '\0') return value;
  std::cout << "SKIPPED: " << variable << " is not set\n";
  return std::nullopt;
}

}  // namespace

TEST_CASE("f_max of the authors' models agrees with an independent program to 1e-12") {
  if (const auto folder = data_folder("STACKABILIZATION_PAPER_DATA")) check_table(*folder, 135);
}

TEST_CASE("f_max of real furniture agrees with an independent program to 1e-12") {
  if (const auto folder = data_folder("STACKABILIZATION_CORPORA")) check_table(*folder / "ikea", 40);
}
