// Question: what does sampling the sphere of directions lose against the refined search, and does the search
// ever miss what dense sampling finds?
//
//     direction_search [--largest N] [--seeds N] [--accuracy S] [--max-cells N] [--threads N] [--paper-data
//     FOLDER] [-o FOLDER] [MODEL...]
//
// S of the search and of the best of 100, 1000 ... N uniform directions: evenly spread (one lattice) and
// drawn at random (`--seeds` times, up to 10,000). One row per model and sampling, with the S that it loses
// (negative where the search is worse) and its best direction; `summary`: over all models; `proof`: the bound
// of `stackability_bound` over all directions. Exit status 1 when the search is worse by more than 1e-6
// anywhere, or a sampled direction exceeds the bound.

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>

#include "common/clock.h"
#include "common/experiment.h"
#include "common/lattice.h"
#include "common/statistics.h"
#include "stackabilization/stacking/direction_bound.h"
#include "stackabilization/stacking/search.h"

using namespace stackabilization;
using namespace stackabilization::experiments;

namespace {

constexpr int fewest = 100, max_random = 10000;

struct Settings {
  int largest = 100000, seeds = 3;
  DirectionBoundOptions proof;
};

/// The best of some directions.
struct Best {
  double S = 0;
  Eigen::Vector3d direction;
  double processor_seconds = 0, seconds = 0;
};

Best best_of(const StackabilitySolver& solver, const std::vector<Direction>& directions) {
  constexpr std::size_t batch = 1000;
  const Stopwatch watch;
  Best best{-std::numeric_limits<double>::infinity(), Eigen::Vector3d::UnitZ()};
  for (std::size_t begin = 0; begin < directions.size(); begin += batch) {
    std::vector<double> values(std::min(batch, directions.size() - begin), best.S);
    tbb::parallel_for(std::size_t{0}, values.size(), [&](std::size_t i) {
      const auto found = solver.measure_if_above(directions[begin + i], best.S);
      if (found) values[i] = found->value;
    });
    const auto highest = std::max_element(values.begin(), values.end());
    if (*highest > best.S)
      best = {*highest, directions[begin + static_cast<std::size_t>(highest - values.begin())].vector()};
  }
  best.processor_seconds = watch.processor_seconds();
  best.seconds = watch.seconds();
  return best;
}

/// S lost by samplings of one kind, and what they cost, over all models and seeds.
struct Losses {
  std::vector<double> lost, processor_seconds;
};

class Comparison {
 public:
  Comparison(const Settings& settings, Report& report)
      : settings_(settings),
        report_(report),
        table_(report.table("", {{"model", ColumnKind::key},
                                 {"input_hash", ColumnKind::key},
                                 {"sampling", ColumnKind::key},
                                 {"seed", ColumnKind::key},
                                 {"directions", ColumnKind::key},
                                 {"S"},
                                 {"S_lost"},
                                 {"x"},
                                 {"y"},
                                 {"z"},
                                 {"cpu_seconds", ColumnKind::clock},
                                 {"seconds", ColumnKind::clock}})),
        proofs_(report.table("proof", {{"model", ColumnKind::key},
                                       {"input_hash", ColumnKind::key},
                                       {"accuracy", ColumnKind::key},
                                       {"S"},
                                       {"bound"},
                                       {"best_sample"},
                                       {"proven"},
                                       {"cells"},
                                       {"open_cells"},
                                       {"cpu_seconds", ColumnKind::clock},
                                       {"seconds", ColumnKind::clock}})) {}

  void add(const std::string& model, const std::string& hash, const Shape& shape) {
    model_ = model;
    hash_ = hash;
    const Stopwatch watch;
    const StackabilitySolver solver(shape);
    const SearchResult found = best_direction(solver);
    searched_ = found.best.value;
    add_row("refined search", {}, static_cast<std::int64_t>(found.evaluated),
            {searched_, found.best.direction, watch.processor_seconds(), watch.seconds()});
    search_directions_.push_back(static_cast<double>(found.evaluated));
    search_seconds_.push_back(watch.processor_seconds());
    double best_sample = -std::numeric_limits<double>::infinity();
    for (int count = fewest; count <= settings_.largest; count *= 10) {
      const Best even = best_of(solver, hemisphere_lattice(count));
      add_sampling("even", {}, count, even);
      best_sample = std::max(best_sample, even.S);
      if (even.S - searched_ > 1e-6) report_.deny();
      for (int seed = 1; count <= max_random && seed <= settings_.seeds; ++seed)
        add_sampling("random", std::int64_t{seed}, count,
                     best_of(solver, random_directions(count, static_cast<unsigned>(seed))));
    }
    prove(solver, found.best, best_sample);
  }

  void summarise() {
    if (search_seconds_.empty()) return;
    Table& table = report_.table("summary", {{"sampling", ColumnKind::key},
                                             {"directions", ColumnKind::key},
                                             {"cases"},
                                             {"median_S_lost"},
                                             {"S_lost_by_90_percent"},
                                             {"largest_S_lost"},
                                             {"median_cpu_seconds", ColumnKind::clock}});
    const std::vector<double> none(search_seconds_.size(), 0);
    table.add({"refined search", static_cast<std::int64_t>(median(search_directions_)),
               static_cast<std::int64_t>(none.size()), 0.0, 0.0, 0.0, median(search_seconds_)});
    for (const auto& [kind, losses] : losses_)
      table.add({kind.first, std::int64_t{kind.second}, static_cast<std::int64_t>(losses.lost.size()),
                 median(losses.lost), quantile(losses.lost, 0.9), quantile(losses.lost, 1),
                 median(losses.processor_seconds)});
    add_plot();
  }

 private:
  void add_row(const std::string& sampling, const Cell& seed, std::int64_t count, const Best& best) {
    table_.add({model_, hash_, sampling, seed, count, best.S, searched_ - best.S, best.direction.x(),
                best.direction.y(), best.direction.z(), best.processor_seconds, best.seconds});
  }

  void prove(const StackabilitySolver& solver, const Stackability& best, double best_sample) {
    const Stopwatch watch;
    const BoundedStackability proof = stackability_bound(solver, best, settings_.proof);
    if (best_sample > proof.bound.bound) report_.deny();
    proofs_.add({model_, hash_, settings_.proof.accuracy, proof.best.value, proof.bound.bound, best_sample,
                 std::int64_t{proof.bound.proven}, proof.bound.cells, proof.bound.open,
                 watch.processor_seconds(), watch.seconds()});
  }

  void add_sampling(const std::string& sampling, const Cell& seed, int count, const Best& best) {
    add_row(sampling, seed, count, best);
    Losses& losses = losses_[{sampling, count}];
    losses.lost.push_back(searched_ - best.S);
    losses.processor_seconds.push_back(best.processor_seconds);
  }

  void add_plot() {
    Plot plot{"S lost by sampling directions, against the refined search",
              {"directions", true},
              {"S lost", true},
              {}};
    const std::map<std::string, int> colours{{"even", 0}, {"random", 1}};
    for (const auto& [name, colour] : colours) {
      Series middle{name + ", median", {}, SeriesStyle::line, colour},
          most{name + ", worst", {}, SeriesStyle::line, colour + 2};
      for (const auto& [kind, losses] : losses_) {
        if (kind.first != name) continue;
        middle.points.emplace_back(kind.second, median(losses.lost));
        most.points.emplace_back(kind.second, quantile(losses.lost, 1));
      }
      plot.series.push_back(std::move(middle));
      plot.series.push_back(std::move(most));
    }
    report_.plot("", plot);
  }

  const Settings& settings_;
  Report& report_;
  Table &table_, &proofs_;
  std::string model_, hash_;
  double searched_ = 0;
  std::vector<double> search_directions_, search_seconds_;
  std::map<std::pair<std::string, int>, Losses> losses_;
};

}  // namespace

int main(int argc, char** argv) {
  Experiment experiment("direction_search",
                        "What does sampling the sphere of directions lose against the refined search?");
  Settings settings;
  experiment.app()
      .add_option("--largest", settings.largest, "directions of the densest sampling")
      ->check(CLI::Range(fewest, 10000000));
  experiment.app()
      .add_option("--seeds", settings.seeds, "random samplings of each size, seeds 1, 2 ...")
      ->check(CLI::Range(0, 1000));
  experiment.app()
      .add_option("--accuracy", settings.proof.accuracy, "of S, of the proofs")
      ->check(CLI::Range(1e-6, 1.0));
  experiment.app()
      .add_option("--max-cells", settings.proof.max_cells, "cells of directions of each proof at most")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{10000000}));
  return experiment.run(argc, argv, [&](Report& report) {
    Comparison comparison(settings, report);
    for_each_model(experiment.models(), report,
                   [&](const ModelFile& model, const Shape& shape, const std::string& hash) {
                     comparison.add(model.name, hash, shape);
                   });
    comparison.summarise();
  });
}
