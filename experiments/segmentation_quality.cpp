// Question: how near does the segmentation come to people's, beside the shape-diameter method?
//
//     segmentation_quality [--threads N] [-o FOLDER] FOLDER
//
// FOLDER is laid out as the benchmark of Chen, Golovinskiy and Funkhouser (2009): models data/off/N.off,
// people's segmentations data/seg/Benchmark/N/N_*.seg, one integer per face and line. One row per model,
// method and number of parts: people's median (as far as the method gets there) or the method's own. The
// figure is one minus the rand index, averaged over the people, which is what the benchmark plots: 0 is
// agreement. The rows of `people` compare each person with the others. Last come the averages over the
// models.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "common/clock.h"
#include "common/experiment.h"
#include "common/rand_index.h"
#include "common/statistics.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/io/read.h"
#include "stackabilization/structure/segmentation.h"

using namespace stackabilization;
using namespace stackabilization::experiments;

namespace {

namespace fs = std::filesystem;
using Labels = std::vector<std::int32_t>;

Labels read_labels(const fs::path& path, Eigen::Index faces) {
  std::ifstream file(path);
  if (!file) throw InputError(path.string() + " cannot be read");
  Labels labels;
  std::string line;
  for (std::int64_t number = 1; std::getline(file, line); ++number) {
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (line.empty()) continue;
    std::int32_t label = 0;
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), label);
    if (error != std::errc() || end != line.data() + line.size())
      throw InputError(path.string() + ", line " + std::to_string(number) + ": expected one integer");
    labels.push_back(label);
  }
  if (static_cast<Eigen::Index>(labels.size()) != faces)
    throw InputError(path.string() + " has " + std::to_string(labels.size()) + " labels, but its model has " +
                     std::to_string(faces) + " faces");
  return labels;
}

double parts_of(const Labels& labels) {
  return static_cast<double>(std::set<std::int32_t>(labels.begin(), labels.end()).size());
}

struct Model {
  std::string name, hash;
  Shape shape;
  std::vector<Labels> people;
};

/// The models that people have cut, by number and then by name.
std::vector<Model> read_models(const fs::path& folder) {
  std::vector<fs::path> files = files_below(folder / "data" / "off", ".off");
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    const std::string x = a.stem().string(), y = b.stem().string();
    return std::make_pair(x.size(), x) < std::make_pair(y.size(), y);
  });
  std::vector<Model> models;
  for (const fs::path& file : files) {
    const fs::path answers = folder / "data" / "seg" / "Benchmark" / file.stem();
    if (!fs::is_directory(answers)) continue;
    Model model{file.stem().string(), file_hash(file), read_shape(file), {}};
    std::set<fs::path> sorted;
    for (const auto& entry : fs::directory_iterator(answers))
      if (entry.path().extension() == ".seg") sorted.insert(entry.path());
    for (const fs::path& answer : sorted)
      model.people.push_back(read_labels(answer, model.shape.triangle_count()));
    if (!model.people.empty()) models.push_back(std::move(model));
  }
  if (models.empty())
    throw InputError(folder.string() +
                     " has no model data/off/N.off with segmentations data/seg/Benchmark/N/N_*.seg");
  return models;
}

struct Row {
  std::string method, number;
  double parts, error, seconds;
};

/// A row of a model, or of the average when there is none.
void add(const Model* model, const Row& row, Table& table) {
  table.add({model ? model->name : "average", model ? Cell(model->hash) : Cell(),
             model ? Cell(std::int64_t{model->shape.triangle_count()}) : Cell(), row.method, row.number,
             row.parts, row.error, row.seconds});
}

/// Each person against the others; a lone one agrees with himself.
Row people_row(const Model& model) {
  Row row{"people", "own", 0, 0, 0};
  const auto count = static_cast<double>(model.people.size());
  for (const Labels& one : model.people) {
    row.parts += parts_of(one) / count;
    for (const Labels& other : model.people)
      row.error += rand_error(one, other) / std::max(1.0, count * (count - 1));
  }
  return row;
}

/// People's median, shared out evenly among the components: methods take a number for each.
int number_per_component(const Model& model) {
  std::vector<double> counts;
  for (const Labels& labels : model.people) counts.push_back(parts_of(labels));
  SegmentationOptions options;
  options.method = SegmentationMethod::components;
  const auto components = static_cast<double>(segment(model.shape, options).part_count());
  return std::max(1, static_cast<int>(std::lround(median(counts) / components)));
}

Row method_row(const Model& model, SegmentationMethod method, bool same_number) {
  SegmentationOptions options;
  options.method = method;
  options.parts = same_number ? number_per_component(model) : 0;
  const double start = now();
  const Shape found = segment(model.shape, options);
  Row row{method == SegmentationMethod::primitives ? "hierarchical_fitting" : "shape_diameter",
          same_number ? "people's" : "own", static_cast<double>(found.part_count()), 0, now() - start};
  for (const Labels& labels : model.people)
    row.error += rand_error(found.triangle_part, labels) / static_cast<double>(model.people.size());
  return row;
}

void compare(const std::vector<Model>& models, Report& report) {
  Table& table = report.table("", {{"model", ColumnKind::key},
                                   {"input_hash", ColumnKind::key},
                                   {"triangles"},
                                   {"method", ColumnKind::key},
                                   {"number_of_parts", ColumnKind::key},
                                   {"parts"},
                                   {"rand_error"},
                                   {"seconds", ColumnKind::clock}});
  std::vector<Row> averages;
  for (const Model& model : models) {
    std::vector<Row> rows{people_row(model)};
    for (const auto method : {SegmentationMethod::primitives, SegmentationMethod::shape_diameter})
      for (const bool same_number : {true, false}) rows.push_back(method_row(model, method, same_number));
    if (averages.empty())
      for (const Row& row : rows) averages.push_back({row.method, row.number, 0, 0, 0});
    for (std::size_t r = 0; r < rows.size(); ++r) {
      add(&model, rows[r], table);
      averages[r].parts += rows[r].parts / static_cast<double>(models.size());
      averages[r].error += rows[r].error / static_cast<double>(models.size());
      averages[r].seconds += rows[r].seconds / static_cast<double>(models.size());
    }
  }
  for (const Row& row : averages) add(nullptr, row, table);
}

}  // namespace

int main(int argc, char** argv) {
  Experiment experiment("segmentation_quality",
                        "How near does the segmentation come to people's, beside the shape-diameter method?",
                        Inputs::none);
  fs::path folder;
  experiment.app().add_option("folder", folder, "folder of the benchmark")->required();
  return experiment.run(argc, argv, [&](Report& report) { compare(read_models(folder), report); });
}
