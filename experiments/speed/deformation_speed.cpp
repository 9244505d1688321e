// Question: how long does the analysis of a shape take, and how long an edit of its controllers with
// everything that follows from it?
//
//     deformation_speed MODEL... [--triangles N] [--edits N] [--seed N] [-o FILE.csv]
//
// One row per model, on one core: milliseconds of the analysis (segmentation, primitives with skeletons,
// symmetries, joints) of the model as given; then, on its mesh subdivided to at least N triangles (default
// 10,000), milliseconds to prepare the controllers, and median and largest milliseconds of an accepted edit -
// moves, turns and scalings of a few per cent of random handles, each from rest - in two shares: propagation
// and solve, and the transfer to the mesh. edit_ms and transfer_ms are medians of each, total_ms and
// slowest_ms median and largest of their sum.

#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <map>
#include <random>

#include "common/provenance.h"
#include "stackabilization/deformation/controller_model.h"
#include "stackabilization/shape/errors.h"
#include "stackabilization/shape/read.h"
#include "stackabilization/shape/write_file.h"
#include "stackabilization/structure/analysis.h"

using namespace stackabilization;
using namespace stackabilization::experiments;

namespace {

struct Options {
  int triangles = 10000, edits = 200;
  unsigned seed = 1;
};

/// Every triangle cut in four at its edge midpoints, which neighbours share.
Shape refined(const Shape& shape) {
  std::map<std::pair<int, int>, int> midpoints;
  std::vector<Eigen::RowVector3d> added;
  Shape fine = shape;
  fine.triangles.resize(4 * shape.triangle_count(), 3);
  fine.triangle_part.clear();
  const auto midpoint = [&](int a, int b) {
    const auto [entry, is_new] = midpoints.try_emplace(
        std::minmax(a, b), static_cast<int>(shape.vertex_count() + static_cast<Eigen::Index>(added.size())));
    if (is_new) added.emplace_back((shape.vertices.row(a) + shape.vertices.row(b)) / 2);
    return entry->second;
  };
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    const int a = shape.triangles(t, 0), b = shape.triangles(t, 1), c = shape.triangles(t, 2);
    const int ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
    fine.triangles.middleRows<4>(4 * t) << a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca;
    for (int k = 0; k < 4; ++k)
      fine.triangle_part.push_back(shape.triangle_part[static_cast<std::size_t>(t)]);
  }
  fine.vertices.conservativeResize(shape.vertex_count() + static_cast<Eigen::Index>(added.size()), 3);
  for (std::size_t i = 0; i < added.size(); ++i)
    fine.vertices.row(shape.vertex_count() + static_cast<Eigen::Index>(i)) = added[i];
  return fine;
}

/// Numbers in [0, 1) that are the same on every machine, unlike the distributions of <random>.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform() { return engine_() / 4294967296.0; }
  Eigen::Vector3d axis() {
    return (uniform() < 0.5 ? 1 : -1) * Eigen::Vector3d::Unit(static_cast<Eigen::Index>(3 * uniform()));
  }

 private:
  std::mt19937 engine_;
};

Edit random_edit(const std::vector<Handle>& handles, double diagonal, Random& random) {
  Edit edit;
  edit.handle = handles[static_cast<std::size_t>(random.uniform() * static_cast<double>(handles.size()))];
  const double choice = random.uniform();
  if (choice < 0.2 && (edit.handle.kind == HandleKind::part || edit.handle.kind == HandleKind::face))
    edit.operation = Rotate{random.axis(), 0.1 * (2 * random.uniform() - 1)};
  else if (choice < 0.5 && edit.handle.kind != HandleKind::corner)
    edit.operation = Scale{0.9 + 0.2 * random.uniform(), std::nullopt};
  else
    edit.operation = Move{0.03 * diagonal * random.uniform() * random.axis()};
  return edit;
}

struct EditTimes {
  std::vector<double> edit, transfer, total;  ///< milliseconds of accepted edits
};

EditTimes time_edits(const ControllerModel& model, const Options& options) {
  const std::vector<Handle> handles = model.handles();
  Random random(options.seed);
  EditTimes times;
  for (int i = 0; i < options.edits; ++i) {
    const Edit edit = random_edit(handles, model.rest().structure.diagonal, random);
    const double start = now();
    const EditOutcome outcome = model.edited(model.rest_primitives(), edit);
    const double solved = now();
    if (outcome.refusal) continue;
    const Shape shape = model.shape_of(outcome.primitives);
    const double end = now();
    times.edit.push_back(1e3 * (solved - start));
    times.transfer.push_back(1e3 * (end - solved));
    times.total.push_back(1e3 * (end - start));
  }
  return times;
}

std::string row_of(const std::string& path, const Options& options) {
  const Shape shape = read_shape(path);
  double start = now();
  StructuredShape structured = analyse_structure(shape);
  const double analysis_ms = 1e3 * (now() - start);
  while (structured.shape.triangle_count() < options.triangles) structured.shape = refined(structured.shape);
  const auto triangles = static_cast<long>(structured.shape.triangle_count());
  const std::size_t parts = structured.structure.parts.size(),
                    relations = structured.structure.relations.size();
  start = now();
  const ControllerModel model(std::move(structured));
  const double prepare_ms = 1e3 * (now() - start);
  const EditTimes times = time_edits(model, options);
  if (times.total.empty()) throw InputError(path + ": none of the edits was accepted");
  char numbers[256];
  std::snprintf(numbers, sizeof numbers, ",%ld,%zu,%zu,%.1f,%ld,%.1f,%d,%zu,%.4f,%.4f,%.4f,%.4f\n",
                static_cast<long>(shape.triangle_count()), parts, relations, analysis_ms, triangles,
                prepare_ms, options.edits, times.total.size(), median(times.edit), median(times.transfer),
                median(times.total), *std::max_element(times.total.begin(), times.total.end()));
  return std::filesystem::path(path).stem().string() + "," + file_hash(path) + numbers;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Time of structure analysis, and of edits of controllers with propagation, solve and mesh transfer."};
  Options options;
  std::vector<std::string> models;
  std::string output = "-";
  app.add_option("models", models, "mesh files")->required()->check(CLI::ExistingFile);
  app.add_option("--triangles", options.triangles, "subdivide until a mesh has this many")
      ->check(CLI::Range(1, 1 << 24));
  app.add_option("--edits", options.edits, "random edits per model")->check(CLI::Range(1, 1000000));
  app.add_option("--seed", options.seed, "of the random edits");
  app.add_option("-o", output, "CSV file; - is standard output");
  CLI11_PARSE(app, argc, argv);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  try {
    std::string csv =
        provenance_lines({"deformation_speed", std::vector<std::string>(argv + 1, argv + argc), 1}) +
        "model,input_hash,triangles,parts,relations,analysis_ms,fine_triangles,prepare_ms,edits,accepted,"
        "edit_ms,transfer_ms,total_ms,slowest_ms\n";
    for (const std::string& model : models) csv += row_of(model, options);
    write_file_atomically(output, csv);
  } catch (const Error& error) {
    std::cerr << "deformation_speed: " << error.what() << "\n";
    return 2;
  }
  return 0;
}
