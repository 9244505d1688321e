// Question: how wrong are the height maps by which robots pack, and is the best place as low as any of a
// grid?
//
//     place_accuracy [--cells N,...] [--reach SHARE] [--accuracy SHARE] [--max-cells N] [--paper-data FOLDER]
//     [-o FOLDER] [MODEL...]
//
// A copy of each model comes down along z onto another one, at the places of a grid around the middle: up to
// --reach of its longer side aside (default 0.1), one cell apart. A height map has N cells along the longer
// side, 30 and 300 by default: 1 cm and 1 mm for an object 30 cm wide. It knows the upper surface of the
// lower object and the lower surface of the upper one, at the centre of each cell or, to be safe, the highest
// and the lowest of 4 x 4 points of it, and lets the copy down until they meet [Wang and Hauser 2019].
// Against it the exact height at the same place.
//
// One row per model and map. Shares of the height of the model: `too_low` where the copy would pierce the
// other by more than a hundredth (share of the places), `deepest` and `too_high`, the largest errors, and
// their `median`, either way; `by_map` is the exact height at the place that the map finds best, `of_grid`
// the least exact height of the grid, `best` that of the search over all places, with its `bound`. Exit
// status 1 if a grid has a place that is lower than that of the search by more than --accuracy.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "common/clock.h"
#include "common/experiment.h"
#include "common/statistics.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/envelope/height_field.h"
#include "stackabilization/stacking/place.h"

using namespace stackabilization;
using namespace stackabilization::experiments;

namespace {

const Direction upwards(0, 0, 1);

struct Settings {
  std::vector<int> cells = {30, 300};
  double reach = 0.1, accuracy = 0.001;
  std::int64_t max_cells = 20'000;
};

/// A height that counts as too low, fraction of the height of the model.
constexpr double pierced = 0.01;

struct Model {
  explicit Model(const Shape& given) : shape(given), place(given_place(given, upwards)) {
    const Frame frame = frame_of(upwards);
    side = std::max(range_along(shape, frame.u).length(), range_along(shape, frame.v).length());
    const Range along = range_along(shape, frame.w);
    low = along.low;
    height = along.length();
  }

  /// Returns the square of the places, `reach` to every side.
  PlaceOptions places(double reach) const {
    PlaceOptions options;
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      options.region.emplace_back(place.x + x * reach, place.y + y * reach);
    return options;
  }

  const Shape& shape;
  Place place;
  double side = 0, low = 0, height = 0;
};

/// How a height map looks at a cell: points along each side of it.
struct Look {
  const char* name;
  int points;
};
constexpr std::array<Look, 2> looks = {{{"centre", 1}, {"extremes", 4}}};

/// Heights of the lowest point of a copy at places some columns and rows of cells aside, by a height map.
class HeightMap {
 public:
  HeightMap(const Model& model, int cells, const Look& look) {
    Window window = window_around(model.shape, upwards, cells);
    cell_ = window.pixel_size;
    upper_.setConstant(window.columns, window.rows, -std::numeric_limits<double>::infinity());
    lower_ = -upper_;
    window.pixel_size /= look.points;
    window.columns *= look.points;
    window.rows *= look.points;
    const HeightField field = height_field_by_rays(model.shape, upwards, window);
    for (int j = 0; j < window.rows; ++j)
      for (int i = 0; i < window.columns; ++i) {
        double &upper = upper_(i / look.points, j / look.points),
               &lower = lower_(i / look.points, j / look.points);
        upper = std::max(upper, field.upper(i, j) - model.low);
        lower = std::min(lower, field.lower(i, j) - model.low);
      }
  }

  double cell() const { return cell_; }

  double height(int columns, int rows) const {
    double highest = 0;  // it stands on the floor where nothing is below it
    const auto wide = static_cast<int>(upper_.rows()), deep = static_cast<int>(upper_.cols());
    for (int j = std::max(0, -rows); j < std::min(deep, deep - rows); ++j)
      for (int i = std::max(0, -columns); i < std::min(wide, wide - columns); ++i)
        highest = std::max(highest, upper_(i + columns, j + rows) - lower_(i, j));
    return highest;
  }

 private:
  double cell_ = 0;
  Eigen::MatrixXd upper_, lower_;  ///< above the floor; infinite where no surface is
};

/// What a height map makes of the places of its grid; shares of the height of the model.
struct MapErrors {
  std::int64_t places = 0;
  double too_low = 0, deepest = 0, too_high = 0, median = 0, by_map = 0, of_grid = 0;
};

MapErrors map_errors(const Model& model, const HeightMap& map, const DropMap& exact) {
  MapErrors found;
  std::vector<double> errors;
  double best_of_map = std::numeric_limits<double>::infinity();
  found.of_grid = best_of_map;
  for (std::size_t j = 0; j < exact.y.size(); ++j)
    for (std::size_t i = 0; i < exact.x.size(); ++i) {
      const auto steps = [&](double from, double to) {
        return static_cast<int>(std::lround((to - from) / map.cell()));
      };
      const double by_map = map.height(steps(model.place.x, exact.x[i]), steps(model.place.y, exact.y[j]));
      const double height = exact.heights[j * exact.x.size() + i];
      errors.push_back((by_map - height) / model.height);
      found.of_grid = std::min(found.of_grid, height / model.height);
      if (by_map < best_of_map) {
        best_of_map = by_map;
        found.by_map = height / model.height;
      }
    }
  found.places = std::ssize(errors);
  found.too_low = static_cast<double>(
                      std::count_if(errors.begin(), errors.end(), [](double e) { return e < -pierced; })) /
                  static_cast<double>(errors.size());
  found.deepest = std::max(0.0, -*std::min_element(errors.begin(), errors.end()));
  found.too_high = std::max(0.0, *std::max_element(errors.begin(), errors.end()));
  for (double& error : errors) error = std::abs(error);
  found.median = median(errors);
  return found;
}

Table& main_table(Report& report) {
  std::vector<Column> all = columns({"model", "input_hash", "cells", "look"}, ColumnKind::key);
  for (const Column& column : columns({"places", "too_low", "deepest", "too_high", "median", "by_map",
                                       "of_grid", "best", "bound", "proven"}))
    all.push_back(column);
  all.push_back({"best_cpu_ms", ColumnKind::clock});
  return report.table("", all);
}

void measure(const Experiment& experiment, const Settings& settings, Report& report) {
  Table& table = main_table(report);
  for_each_model(experiment.models(), report,
                 [&](const ModelFile& file, const Shape& shape, const std::string& hash) {
                   const Model model(shape);
                   if (!(model.height > 0 && model.side > 0))
                     throw InputError(file.path.string() + ": the model is flat along z or across it");
                   PlaceOptions options = model.places(settings.reach * model.side);
                   options.accuracy = settings.accuracy * model.height;
                   options.max_cells = settings.max_cells;
                   const Stopwatch watch;
                   const BestPlace best = best_place(shape, shape, upwards, options);
                   const double best_cpu_ms = 1e3 * watch.processor_seconds();
                   const double height = best.drop.height / model.height;
                   for (const int cells : settings.cells) {
                     const DropMap exact = drop_map(shape, shape, upwards, model.side / cells, 0, options);
                     for (const Look& look : looks) {
                       const MapErrors map = map_errors(model, HeightMap(model, cells, look), exact);
                       table.add({file.name, hash, std::int64_t{cells}, std::string(look.name), map.places,
                                  map.too_low, map.deepest, map.too_high, map.median, map.by_map, map.of_grid,
                                  height, best.bound / model.height, best.proven, best_cpu_ms});
                       if (height > map.of_grid + settings.accuracy) report.deny();
                     }
                   }
                 });
}

}  // namespace

int main(int argc, char** argv) {
  Experiment experiment(
      "place_accuracy",
      "How wrong are the height maps by which robots pack, and is the best place as low as any of a grid?");
  Settings settings;
  experiment.app()
      .add_option("--cells", settings.cells, "cells of a height map along the longer side of the model")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Range(2, 4096));
  experiment.app()
      .add_option("--reach", settings.reach, "how far aside a copy may be, share of the longer side")
      ->check(CLI::Range(1e-3, 1.0));
  experiment.app()
      .add_option("--accuracy", settings.accuracy, "of the best place, share of the height")
      ->check(CLI::Range(1e-6, 1.0));
  experiment.app()
      .add_option("--max-cells", settings.max_cells, "cells of places to examine at most")
      ->check(CLI::Range(1, 1 << 24));
  return experiment.run(argc, argv, [&](Report& report) { measure(experiment, settings, report); });
}
