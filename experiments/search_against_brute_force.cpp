// Question: does the direction search ever miss a direction that dense uniform sampling finds?
//
//     search_against_brute_force [--directions N] [--threads N] [-o FILE.csv] MODEL...
//
// One row per model: the best S of the search, the best S of N (default 100,000) evenly spread directions of
// the hemisphere, their difference (negative where the search is worse), seconds of both, the number of
// directions that the search tried, and the best direction. Exit status 1 when the search is worse by more
// than 1e-6 anywhere.

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "common/lattice.h"
#include "common/provenance.h"
#include "stackabilization/shape/errors.h"
#include "stackabilization/shape/read.h"
#include "stackabilization/shape/write_file.h"
#include "stackabilization/stacking/search.h"

using namespace stackabilization;
using namespace stackabilization::experiments;

namespace {

double best_of(const StackabilitySolver& solver, const std::vector<Direction>& directions) {
  constexpr std::size_t batch = 1000;
  double best = -std::numeric_limits<double>::infinity();
  for (std::size_t begin = 0; begin < directions.size(); begin += batch) {
    std::vector<double> values(std::min(batch, directions.size() - begin), best);
    tbb::parallel_for(std::size_t{0}, values.size(), [&](std::size_t i) {
      const auto found = solver.measure_if_above(directions[begin + i], best);
      if (found) values[i] = found->value;
    });
    best = std::max(best, *std::max_element(values.begin(), values.end()));
  }
  return best;
}

struct Row {
  std::string model, hash;
  long triangles;
  double searched, brute, search_seconds, brute_seconds;
  long tried;
  Eigen::Vector3d direction;

  bool worse() const { return searched < brute - 1e-6; }
  std::string text() const {
    char numbers[320];
    std::snprintf(numbers, sizeof numbers, "%ld,%.17g,%.17g,%.3g,%.3f,%.3f,%ld,%.17g,%.17g,%.17g", triangles,
                  searched, brute, searched - brute, search_seconds, brute_seconds, tried, direction.x(),
                  direction.y(), direction.z());
    return model + "," + hash + "," + numbers + "\n";
  }
  static std::string header() {
    return "model,input_hash,triangles,S_search,S_brute,difference,search_seconds,brute_seconds,search_"
           "directions,x,y,z\n";
  }
};

Row compare(const std::string& model, const std::vector<Direction>& directions) {
  const Shape shape = read_shape(model);
  const double start = now();
  const StackabilitySolver solver(shape);
  const SearchResult found = best_direction(solver);
  const double middle = now();
  const double brute = best_of(solver, directions);
  return {
      model,          file_hash(model), static_cast<long>(shape.triangle_count()), found.best.value,    brute,
      middle - start, now() - middle,   static_cast<long>(found.evaluated),        found.best.direction};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Does the direction search ever miss a direction that dense uniform sampling finds?"};
  int directions = 100000, threads = tbb::info::default_concurrency();
  std::string output = "-";
  std::vector<std::string> models;
  app.add_option("--directions", directions, "directions of the brute force")->check(CLI::Range(1, 10000000));
  app.add_option("--threads", threads, "threads of both")->check(CLI::Range(1, 1024));
  app.add_option("-o", output, "CSV file; - is standard output");
  app.add_option("models", models, "mesh files")->required();
  CLI11_PARSE(app, argc, argv);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  try {
    const std::vector<Direction> lattice = hemisphere_lattice(directions);
    std::string csv = provenance_lines({"search_against_brute_force",
                                        std::vector<std::string>(argv + 1, argv + argc), threads}) +
                      Row::header();
    bool ever_worse = false;
    for (const std::string& model : models) {
      const Row row = compare(model, lattice);
      csv += row.text();
      ever_worse = ever_worse || row.worse();
    }
    write_file_atomically(output, csv);
    return ever_worse ? 1 : 0;
  } catch (const InputError& error) {
    std::cerr << "search_against_brute_force: " << error.what() << "\n";
    return 3;
  } catch (const Error& error) {
    std::cerr << "search_against_brute_force: " << error.what() << "\n";
    return 2;
  }
}
