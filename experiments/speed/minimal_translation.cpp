// Question: do five ways to the minimal translation agree, and what does one more direction cost by each?
//
//     minimal_translation [--directions N] [--slow-directions N] [--paper-data FOLDER] [-o FOLDER] [MODEL...]
//
// Exact separation, as a rational number and as an interval; height fields by rasters (CPU, OpenGL) and by
// rays (CGAL, Embree); bisection of collision tests (CGAL, FCL); the Minkowski sum (CGAL Nef polyhedra), on
// some small solids besides the models, for it takes no large ones. All on one thread.
//
// One row per model and method: the largest and the least error of f_max over the directions, as fractions of
// h, against the exact value of the semantics that the method looks for; processor milliseconds to prepare
// the shape, median and largest per direction, and the ratio of the median to that of the exact interval.
// Methods slower than the exact ones by far are run on fewer directions. `summary`: the same over all models.

#include <algorithm>
#include <cmath>
#include <map>

#include "common/clock.h"
#include "common/experiment.h"
#include "common/lattice.h"
#include "common/statistics.h"
#include "speed/competitor.h"
#include "speed/small_solids.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/envelope/height_field.h"
#include "stackabilization/mesh/closed_surface.h"
#include "stackabilization/stacking/minkowski.h"
#ifdef STACKABILIZATION_WITH_RENDERING
#include "stackabilization/rendering/depth_raster.h"
#endif

namespace stackabilization::experiments {
namespace {

struct Settings {
  int directions = 200, slow_directions = 10;
};

std::vector<Competitor> exact(const Shape& shape) {
  const Stopwatch watch;
  const auto tree = std::make_shared<SeparationTree>(shape);
  const double build_seconds = watch.processor_seconds();
  return {{"exact (rational)", ContactSemantics::solid, build_seconds,
           [tree](const Direction& direction) { return separation(*tree, *tree, direction).length; }},
          {"exact (interval)", ContactSemantics::solid, build_seconds, [tree](const Direction& direction) {
             return separation_enclosure(*tree, *tree, direction).upper * direction.length();
           }}};
}

Competitor scanline(const Shape& shape, int resolution) {
  return {"CPU raster " + std::to_string(resolution), ContactSemantics::solid, 0,
          [&shape, resolution](const Direction& direction) {
            const Window window = window_around(shape, direction, resolution);
            return maximum_gap(height_field_by_scanline(shape, direction, window)).value;
          }};
}

Competitor rays(const Shape& shape, int resolution) {
  const Stopwatch watch;
  const auto caster = std::make_shared<RayCaster>(shape);
  return {"CGAL rays " + std::to_string(resolution), ContactSemantics::solid, watch.processor_seconds(),
          [caster, &shape, resolution](const Direction& direction) {
            return maximum_gap(caster->cast(direction, window_around(shape, direction, resolution))).value;
          }};
}

#ifdef STACKABILIZATION_WITH_RENDERING
Competitor depth_buffer(const Shape& shape, int resolution) {
  const Stopwatch watch;
  const auto rasterizer = std::make_shared<DepthRasterizer>(shape);
  return {"OpenGL raster " + std::to_string(resolution), ContactSemantics::solid, watch.processor_seconds(),
          [rasterizer, &shape, resolution](const Direction& direction) {
            const Window window = window_around(shape, direction, resolution);
            return maximum_gap(rasterizer->height_field(direction, window)).value;
          }};
}
#endif

std::vector<Competitor> competitors(const Shape& shape) {
  std::vector<Competitor> list = exact(shape);
  list.push_back(scanline(shape, 256));
  list.push_back(scanline(shape, 1024));
#ifdef STACKABILIZATION_WITH_RENDERING
  list.push_back(depth_buffer(shape, 1024));
#endif
  list.push_back(rays(shape, 256));
#ifdef STACKABILIZATION_WITH_EMBREE
  list.push_back(embree_rays(shape, 1024));
#endif
#ifdef STACKABILIZATION_WITH_FCL
  list.push_back(fcl_bisection(shape));
#endif
  for (Competitor& bisection : cgal_bisections(shape)) list.push_back(std::move(bisection));
  if (shape.triangle_count() <= max_minkowski_triangles && closed_surface(shape).closed)
    list.push_back({"Minkowski sum", ContactSemantics::solid, 0, [&shape](const Direction& direction) {
                      return minkowski_translation(shape, direction).to_double() * direction.length();
                    }});
  return list;
}

struct Row {
  std::string method;
  int directions = 0;
  double least_error = 0, largest_error = 0;  ///< over h
  double build_ms = 0, median_ms = 0, largest_ms = 0, ratio = 1;

  double error() const { return std::max(largest_error, -least_error); }
};

/// Exact values by direction, in both semantics.
struct Reference {
  std::vector<double> solid, closed, extent;
};

Reference reference(const Shape& shape, const std::vector<Direction>& directions) {
  const SeparationTree tree(shape);
  Reference result;
  for (const Direction& r : directions) {
    result.solid.push_back(separation(tree, tree, r).length);
    result.closed.push_back(separation(tree, tree, r, {ContactSemantics::closed, {}}).length);
    result.extent.push_back(range_along(shape, r.unit()).length());
  }
  return result;
}

Row measured(const Competitor& competitor, const std::vector<Direction>& directions,
             const Reference& reference, int runs) {
  Row row{competitor.name, runs, INFINITY, -INFINITY, 1e3 * competitor.build_seconds, 0, 0, 1};
  std::vector<double> times;
  for (int d = 0; d < runs; ++d) {
    // The slow ones see directions spread over the whole list.
    const std::size_t at = static_cast<std::size_t>(d) * directions.size() / static_cast<std::size_t>(runs);
    const Stopwatch watch;
    const double value = competitor.measure(directions[at]);
    times.push_back(1e3 * watch.processor_seconds());
    const bool solid = competitor.semantics == ContactSemantics::solid;
    const double error = (value - (solid ? reference.solid : reference.closed)[at]) / reference.extent[at];
    row.least_error = std::min(row.least_error, error);
    row.largest_error = std::max(row.largest_error, error);
  }
  row.median_ms = median(times);
  row.largest_ms = quantile(times, 1);
  return row;
}

/// Of the list of competitors, after the rational number.
constexpr std::size_t interval_row = 1;

std::vector<Row> compare(const Shape& shape, const Settings& settings) {
  const std::vector<Direction> directions = hemisphere_lattice(settings.directions);
  const Reference truth = reference(shape, directions);
  std::vector<Row> rows;
  for (const Competitor& competitor : competitors(shape)) {
    const bool quick = rows.size() < 2;
    const int runs = quick ? settings.directions : std::min(settings.directions, settings.slow_directions);
    rows.push_back(measured(competitor, directions, truth, runs));
  }
  for (Row& row : rows) row.ratio = row.median_ms / rows[interval_row].median_ms;
  return rows;
}

using ByMethod = std::map<std::string, std::vector<Row>>;

void add_rows(const std::string& model, const std::string& hash, const std::vector<Row>& rows,
              Report& report) {
  Table& table = report.table("", {{"model", ColumnKind::key},
                                   {"input_hash", ColumnKind::key},
                                   {"method", ColumnKind::key},
                                   {"directions"},
                                   {"least_error_over_h"},
                                   {"largest_error_over_h"},
                                   {"build_cpu_ms", ColumnKind::clock},
                                   {"median_cpu_ms", ColumnKind::clock},
                                   {"largest_cpu_ms", ColumnKind::clock},
                                   {"ratio_to_interval", ColumnKind::clock}});
  for (const Row& row : rows)
    table.add({model, hash, row.method, std::int64_t{row.directions}, row.least_error, row.largest_error,
               row.build_ms, row.median_ms, row.largest_ms, row.ratio});
}

void add_summary(const ByMethod& methods, Report& report) {
  Table& table = report.table("summary", {{"method", ColumnKind::key},
                                          {"models", ColumnKind::key},
                                          {"median_error_over_h"},
                                          {"largest_error_over_h"},
                                          {"median_cpu_ms", ColumnKind::clock},
                                          {"least_cpu_ms", ColumnKind::clock},
                                          {"largest_cpu_ms", ColumnKind::clock},
                                          {"median_ratio_to_interval", ColumnKind::clock},
                                          {"least_ratio_to_interval", ColumnKind::clock},
                                          {"largest_ratio_to_interval", ColumnKind::clock}});
  for (const auto& [method, rows] : methods) {
    std::vector<double> errors, times, ratios;
    for (const Row& row : rows) {
      errors.push_back(row.error());
      times.push_back(row.median_ms);
      ratios.push_back(row.ratio);
    }
    const auto [least, most] = std::minmax_element(times.begin(), times.end());
    table.add({method, static_cast<std::int64_t>(rows.size()), median(errors), quantile(errors, 1),
               median(times), *least, *most, median(ratios), *std::min_element(ratios.begin(), ratios.end()),
               quantile(ratios, 1)});
  }
}

void add_plot(const ByMethod& methods, Report& report) {
  constexpr double min_shown = 1e-16;
  Plot plot{"The minimal translation by every road, one mark per model",
            {"processor milliseconds per direction", true},
            {"largest error of f_max / h (1e-16: none)", true},
            {}};
  for (const auto& [method, rows] : methods) {
    Series series{method, {}, SeriesStyle::dots, static_cast<int>(plot.series.size()) % plot_colours};
    for (const Row& row : rows) series.points.emplace_back(row.median_ms, std::max(row.error(), min_shown));
    plot.series.push_back(std::move(series));
  }
  report.plot("", plot);
}

}  // namespace
}  // namespace stackabilization::experiments

int main(int argc, char** argv) {
  using namespace stackabilization;
  using namespace stackabilization::experiments;
  Experiment experiment(
      "minimal_translation",
      "Do five ways to the minimal translation agree, and what does a direction cost by each?",
      Inputs::models, Threads::one);
  Settings settings;
  experiment.app()
      .add_option("--directions", settings.directions, "directions for the exact method")
      ->check(CLI::Range(1, 100000));
  experiment.app()
      .add_option("--slow-directions", settings.slow_directions, "directions for every other method")
      ->check(CLI::Range(1, 100000));
  return experiment.run(argc, argv, [&](Report& report) {
    const std::vector<ModelFile> models = experiment.models();
    ByMethod methods;
    const auto measure = [&](const std::string& name, const Shape& shape, const std::string& hash) {
      const std::vector<Row> rows = compare(shape, settings);
      add_rows(name, hash, rows, report);
      for (const Row& row : rows) methods[row.method].push_back(row);
    };
    for (const auto& [name, shape] : small_solids()) measure(name, shape, "");
    for_each_model(models, report, [&](const ModelFile& model, const Shape& shape, const std::string& hash) {
      measure(model.name, shape, hash);
    });
    add_summary(methods, report);
    add_plot(methods, report);
  });
}
