// Question: how does the cost grow with triangles, directions, parts and threads?
//
//     scaling [--largest-triangles N] [--largest-parts N] [--directions N]
//             [--finest-spacing A] [--threads N] [-o FOLDER]
//
// Triangles: a thin-walled cup with a wavy wall, from 1,000 triangles doubling up to N, on one thread: the
// tree, and one more direction as an interval and as a rational number, over evenly spread directions, and
// along the axis of the cup, where its whole wall slides into itself (medians). Sheets, of as many triangles:
// a bumpy bowl without thickness, along z and aslant, where every triangle touches its copy and its
// neighbours, and an upright tube, whose walls slide over their whole length. Directions: the best of 100,
// 200 ... evenly spread ones, and beside them the search with sample spacings that try as many. Parts: a rack
// of 4, 8 ... N bars between two posts: analysis of its structure, and one more direction. Threads: one
// direction search on 1, 2 ... threads.
//
// One row per quantity and size, with the answer that was computed, which no thread count may change, and
// processor and wall-clock milliseconds; `exponents`: least-squares power laws, 1 being linear.

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "common/clock.h"
#include "common/experiment.h"
#include "common/generated_models.h"
#include "common/lattice.h"
#include "common/statistics.h"
#include "stackabilization/envelope/separation.h"
#include "stackabilization/stacking/search.h"
#include "stackabilization/structure/analysis.h"

using namespace stackabilization;
using namespace stackabilization::experiments;

namespace {

constexpr double coarsest_spacing = 0.32;

struct Settings {
  int max_triangles = 1 << 20, max_parts = 128, directions = 50;
  double finest_spacing = 0.02;  ///< radians
};

/// What one measurement found and took.
struct Measurement {
  double answer = 0, processor_ms = 0, ms = 0;
};

template <class Work>
Measurement timed(const Work& work) {
  const Stopwatch watch;
  const double answer = work();
  return {answer, 1e3 * watch.processor_seconds(), 1e3 * watch.seconds()};
}

/// Medians over the directions; the answer is the sum, in which every one counts.
template <class Query>
Measurement timed_each(const std::vector<Direction>& directions, const Query& query) {
  std::vector<double> processor, wall;
  double sum = 0;
  for (const Direction& direction : directions) {
    const Measurement one = timed([&] { return query(direction); });
    sum += one.answer;
    processor.push_back(one.processor_ms);
    wall.push_back(one.ms);
  }
  return {sum, median(processor), median(wall)};
}

class Scaling {
 public:
  Scaling(const Settings& settings, int threads, Report& report)
      : settings_(settings),
        threads_(threads),
        report_(report),
        lattice_(hemisphere_lattice(settings.directions)),
        table_(report.table("", {{"against", ColumnKind::key},
                                 {"quantity", ColumnKind::key},
                                 {"size", ColumnKind::key},
                                 {"answer"},
                                 {"cpu_ms", ColumnKind::clock},
                                 {"ms", ColumnKind::clock}})) {}

  void run() {
    {
      const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
      against_triangles();
      against_triangles_of_sheets();
      against_directions();
      against_parts();
    }
    against_threads();
    add_exponents();
    plot("triangles", "Cost of the exact separation, wavy cup, one thread");
    plot("triangles of a sheet", "Cost of the exact separation, sheets, one thread");
    plot("directions", "Cost of the best direction, wavy cup, one thread");
    plot("parts", "Cost of a rack with more and more parts, one thread");
    plot("threads", "Search of the best direction on several threads");
  }

 private:
  void add(const std::string& against, const std::string& quantity, std::int64_t size,
           const Measurement& found) {
    table_.add({against, quantity, size, found.answer, found.processor_ms, found.ms});
    series_[against][quantity].emplace_back(static_cast<double>(size),
                                            against == "threads" ? found.ms : found.processor_ms);
  }

  void against_triangles() {
    for (int triangles = 1024; triangles <= settings_.max_triangles; triangles *= 2) {
      const Shape shape = wavy_cup(triangles);
      std::optional<SeparationTree> tree;
      const auto add_quantity = [&](const std::string& quantity, const Measurement& found) {
        add("triangles", quantity, shape.triangle_count(), found);
      };
      const auto exact = [&](const Direction& r) { return separation(*tree, *tree, r).length; };
      add_quantity("tree, once per shape", timed([&] {
                     tree.emplace(shape);
                     return 0.0;
                   }));
      add_quantity("one direction, interval", timed_each(lattice_, [&](const Direction& r) {
                     return separation_enclosure(*tree, *tree, r).upper * r.length();
                   }));
      add_quantity("one direction, rational", timed_each(lattice_, exact));
      add_quantity("along the axis, rational", timed_each({5, Direction(0, 0, 1)}, exact));
    }
  }

  void against_triangles_of_sheets() {
    for (int triangles = 1024; triangles <= settings_.max_triangles; triangles *= 2) {
      const auto add_query = [&](const std::string& quantity, const Shape& shape, const Direction& r) {
        const SeparationTree tree(shape);
        add("triangles of a sheet", quantity, shape.triangle_count(),
            timed([&] { return separation(tree, tree, r).length; }));
      };
      const Shape bowl = bumpy_bowl(triangles);
      add_query("bowl, along z", bowl, Direction(0, 0, 1));
      add_query("bowl, aslant", bowl, Direction(0.3, -0.2, 1));
      add_query("tube, along z", oval_tube(triangles), Direction(0, 0, 1));
    }
  }

  void against_directions() {
    const StackabilitySolver solver(wavy_cup(std::min(settings_.max_triangles, 4096)));
    for (int count = 100; count <= 6400; count *= 2)
      add("directions", "best of even directions", count, timed([&] {
            double best = -1;
            for (const Direction& r : hemisphere_lattice(count))
              if (const auto found = solver.measure_if_above(r, best)) best = std::max(best, found->value);
            return best;
          }));
    for (double spacing = coarsest_spacing; spacing >= settings_.finest_spacing; spacing /= 2) {
      SearchOptions options;
      options.spacing = spacing;
      std::int64_t tried = 0;
      const Measurement found = timed([&] {
        const SearchResult result = best_direction(solver, options);
        tried = result.evaluated;
        return result.best.value;
      });
      add("directions", "search", tried, found);
    }
  }

  void against_parts() {
    for (int parts = 4; parts <= settings_.max_parts; parts *= 2) {
      const Shape shape = rack(parts);
      AnalysisOptions options;
      options.segmentation.method = SegmentationMethod::given;
      add("parts", "analysis of the structure", parts, timed([&] {
            return static_cast<double>(analyse_structure(shape, options).structure.relations.size());
          }));
      const SeparationTree tree(shape);
      add("parts", "one direction, rational", parts,
          timed_each(lattice_, [&](const Direction& r) { return separation(tree, tree, r).length; }));
    }
  }

  void against_threads() {
    const StackabilitySolver solver(wavy_cup(std::min(settings_.max_triangles, 1 << 14)));
    SearchOptions options;
    options.spacing = std::max(options.spacing, settings_.finest_spacing);
    for (int threads = 1; threads <= threads_; threads *= 2) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(threads));
      add("threads", "search", threads, timed([&] { return best_direction(solver, options).best.value; }));
    }
  }

  void add_exponents() {
    Table& table = report_.table(
        "exponents",
        {{"against", ColumnKind::key}, {"quantity", ColumnKind::key}, {"exponent", ColumnKind::clock}});
    for (const auto& [against, quantities] : series_)
      for (const auto& [quantity, points] : quantities)
        if (const auto law = power_law(points)) table.add({against, quantity, law->exponent});
  }

  void plot(const std::string& against, const std::string& title) {
    Plot plot{title, {against, true}, {"processor milliseconds", true}, {}};
    if (against == "threads") plot.y.title = "milliseconds";
    for (const auto& [quantity, points] : series_[against])
      plot.series.push_back({quantity, points, SeriesStyle::line, static_cast<int>(plot.series.size())});
    const Eigen::Vector2d first = plot.series.back().points.front(), last = plot.series.back().points.back();
    const double unit = first.y() / first.x();
    const bool shared = against == "threads";  // as many threads, that much less time
    plot.series.push_back(
        {shared ? "ideal" : "linear",
         {first, {last.x(), shared ? unit * first.x() * first.x() / last.x() : unit * last.x()}},
         SeriesStyle::reference,
         7});
    report_.plot(against, plot);
  }

  const Settings& settings_;
  int threads_;
  Report& report_;
  std::vector<Direction> lattice_;
  Table& table_;
  std::map<std::string, std::map<std::string, std::vector<Eigen::Vector2d>>> series_;
};

}  // namespace

int main(int argc, char** argv) {
  Experiment experiment("scaling", "How does the cost grow with triangles, directions, parts and threads?",
                        Inputs::none);
  Settings settings;
  experiment.app()
      .add_option("--largest-triangles", settings.max_triangles, "triangles of the largest cup")
      ->check(CLI::Range(2048, 1 << 24));
  experiment.app()
      .add_option("--largest-parts", settings.max_parts, "parts of the largest rack")
      ->check(CLI::Range(8, 4096));
  experiment.app()
      .add_option("--directions", settings.directions, "directions per shape")
      ->check(CLI::Range(1, 100000));
  experiment.app()
      .add_option("--finest-spacing", settings.finest_spacing, "radians between samples of the finest search")
      ->check(CLI::Range(1e-3, coarsest_spacing));
  return experiment.run(argc, argv,
                        [&](Report& report) { Scaling(settings, experiment.threads(), report).run(); });
}
