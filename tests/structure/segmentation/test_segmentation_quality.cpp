#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "common/rand_index.h"
#include "stackabilization/io/read.h"
#include "stackabilization/io/write.h"
#include "support/catch.h"
#include "support/voxels.h"

using namespace stackabilization;
namespace fs = std::filesystem;

namespace {

/// One per process: tests run side by side.
struct BenchmarkFolder {
  fs::path path = fs::temp_directory_path() / ("segmentation_benchmark_" + std::to_string(getpid()));
  ~BenchmarkFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

const BenchmarkFolder benchmark;
const fs::path& folder = benchmark.path;

void write_labels(const std::string& model, int person, const std::vector<std::int32_t>& labels) {
  const fs::path place = folder / "data" / "seg" / "Benchmark" / model;
  fs::create_directories(place);
  std::ofstream file(place / (model + "_" + std::to_string(person) + ".seg"));
  for (const std::int32_t label : labels) file << label << "\n";
}

void write_model(const std::string& name, const Shape& shape) {
  fs::create_directories(folder / "data" / "off");
  write_shape(shape, folder / "data" / "off" / (name + ".off"));
  write_labels(name, 0, shape.triangle_part);
  write_labels(name, 1, shape.triangle_part);
}

int run(const std::string& arguments) {
  std::ostringstream command;
  command << '"' << SEGMENTATION_QUALITY_PROGRAM << "\" " << arguments << " 2>/dev/null";
  return std::system(command.str().c_str());
}

std::string quoted(const fs::path& path) {
  std::ostringstream text;
  text << path;  // in quotes
  return text.str();
}

/// Error per "model,method,number_of_parts".
std::map<std::string, double> errors(const fs::path& csv) {
  std::map<std::string, double> result;
  std::ifstream file(csv);
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("#") || line.starts_with("model,")) continue;
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    REQUIRE(cells.size() == 7);
    result[cells[0] + "," + cells[3] + "," + cells[4]] = std::stod(cells[6]);
  }
  return result;
}

}  // namespace

TEST_CASE("the rand error counts the pairs that two segmentations disagree on") {
  using experiments::rand_error;
  CHECK(rand_error({0, 0, 1, 1}, {7, 7, 3, 3}) == 0);
  CHECK(rand_error({0, 0, 0}, {0, 1, 2}) == 1);
  // Pairs 01, 23 together on the left, 12 on the right: three of six.
  CHECK(rand_error({0, 0, 1, 1}, {0, 1, 1, 2}) == Approx(0.5));
}

TEST_CASE("the benchmark finds that both methods do as well as people on what is plain") {
  fs::remove_all(folder);
  write_model("1", solids::grid_union(
                       {{{0, 0, 12}, {16, 16, 14}}, {{1, 1, 0}, {3, 3, 12}}, {{13, 13, 0}, {15, 15, 12}}}));
  write_model("2", read_shape(fs::path(STACKABILIZATION_SOURCE_DIR) / "data" / "models" / "cup.obj"));
  const fs::path results = folder / "results";
  REQUIRE(run("-o " + quoted(results) + " " + quoted(folder)) == 0);
  std::map<std::string, double> error = errors(results / "segmentation_quality.csv");
  CHECK(error.size() == 15);  // people, and two methods with two numbers, on two models and on average
  CHECK(error.at("1,people,own") == 0);
  CHECK(error.at("1,hierarchical_fitting,people's") < 0.01);
  CHECK(error.at("2,hierarchical_fitting,own") == 0);
  CHECK(error.at("average,shape_diameter,own") ==
        Approx((error.at("1,shape_diameter,own") + error.at("2,shape_diameter,own")) / 2).margin(1e-5));
}

TEST_CASE("labels that do not fit the model are refused") {
  fs::remove_all(folder);
  write_model("1", solids::grid_union({{{0, 0, 0}, {1, 1, 1}}}));
  write_labels("1", 1, {0, 1});
  CHECK(run(quoted(folder) + " >/dev/null") != 0);
  fs::remove_all(folder / "data" / "seg");
  CHECK(run(quoted(folder) + " >/dev/null") != 0);
}
