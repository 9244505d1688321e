// Question: does the direction search ever miss a direction that dense uniform sampling finds?
//
//     search_against_brute_force [--directions N] MODEL...
//
// One row per model, comma separated: the best S of the search, the best S of N (default 100,000) directions
// of a Fibonacci lattice on the hemisphere, their difference (negative where the search is worse), both times
// in seconds, the numbers of directions, and the threads used. Exit status 1 when the search is worse by more
// than 1e-6 anywhere.

#include <tbb/info.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/shape/errors.h"
#include "stackabilization/shape/read.h"
#include "stackabilization/stacking/search.h"

using namespace stackabilization;

namespace {

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Direction lattice_direction(int i, int count) {
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  const double z = 1 - (i + 0.5) / count, radius = std::sqrt((1 - z) * (1 + z));
  return Direction(radius * std::cos(golden_angle * i), radius * std::sin(golden_angle * i), z);
}

double brute_force(const StackabilitySolver& solver, int count) {
  constexpr int batch = 1000;
  double best = -std::numeric_limits<double>::infinity();
  for (int begin = 0; begin < count; begin += batch) {
    std::vector<double> values(std::min(batch, count - begin), best);
    tbb::parallel_for(std::size_t{0}, values.size(), [&](std::size_t i) {
      const auto found = solver.measure_if_above(lattice_direction(begin + static_cast<int>(i), count), best);
      if (found) values[i] = found->value;
    });
    best = std::max(best, *std::max_element(values.begin(), values.end()));
  }
  return best;
}

bool compare(const std::string& model, int count) {
  const Shape shape = read_shape(model);
  const double start = seconds();
  const StackabilitySolver solver(shape);
  const SearchResult searched = best_direction(solver);
  const double middle = seconds();
  const double brute = brute_force(solver, count);
  const double difference = searched.best.value - brute;
  const Eigen::Vector3d& r = searched.best.direction;
  std::printf("%s,%lld,%.17g,%.17g,%.3g,%.3f,%.3f,%lld,%d,%d,%.17g,%.17g,%.17g\n", model.c_str(),
              static_cast<long long>(shape.triangle_count()), searched.best.value, brute, difference,
              middle - start, seconds() - middle, static_cast<long long>(searched.evaluated), count,
              tbb::info::default_concurrency(), r.x(), r.y(), r.z());
  std::fflush(stdout);
  return difference >= -1e-6;
}

}  // namespace

int main(int argc, char** argv) {
  int count = 100000;
  bool never_worse = true;
  std::printf(
      "model,triangles,S_search,S_brute,difference,search_seconds,brute_seconds,search_directions,"
      "brute_directions,threads,x,y,z\n");
  try {
    for (int i = 1; i < argc; ++i) {
      if (std::string(argv[i]) == "--directions" && i + 1 < argc)
        count = std::max(1, std::atoi(argv[++i]));
      else
        never_worse = compare(argv[i], count) && never_worse;
    }
  } catch (const Error& error) {
    std::fprintf(stderr, "search_against_brute_force: %s\n", error.what());
    return 3;
  }
  return never_worse ? 0 : 1;
}
