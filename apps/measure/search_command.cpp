#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>

#include "apps/common/command.h"
#include "apps/common/measurement.h"
#include "apps/common/output.h"
#include "apps/common/progress.h"
#include "apps/common/rendering.h"
#include "apps/common/values.h"
#include "stackabilization/core/number_text.h"
#include "stackabilization/stacking/search.h"

namespace stackabilization::apps {

namespace {

struct SearchCommandOptions {
  CommonOptions common;
  StackabilityOptions stackability;
  std::optional<double> cone_degrees;
  std::optional<Eigen::Vector3d> direction;
  std::optional<Eigen::Vector3d> plane;
  std::optional<double> certify;
  std::optional<std::int64_t> max_cells;
  std::optional<std::string> picture;
};

/// Local optima that the text names; the JSON has all.
constexpr std::size_t listed_optima = 5;
/// Cells of the proof that no option asks for. Nearly every model is proven with fewer, in less time than the
/// search takes.
constexpr std::int64_t unasked_cells = 10'000;

SearchOptions search_options(const SearchCommandOptions& options) {
  SearchOptions search;
  if (options.direction && !options.cone_degrees)
    throw UsageError("--direction is the axis of a cone here: give --cone-degrees too");
  if (options.cone_degrees)
    search.cone = {options.direction.value_or(Eigen::Vector3d::UnitZ()),
                   *options.cone_degrees * std::numbers::pi / 180};
  search.plane_normal = options.plane;
  const bool bounded = options.stackability.boxes == BoxModel::oriented;
  refuse_option(options.certify && !bounded, "--certify", "knows a bound for --boxes oriented only");
  refuse_option(options.max_cells && !bounded, "--max-cells", "knows a bound for --boxes oriented only");
  refuse_option(options.certify && options.max_cells == 0, "--certify", "needs cells: give --max-cells more");
  if (!bounded || options.max_cells == 0) return search;
  search.certify = options.certify.value_or(tolerance::direction_bound);
  search.max_cells = options.max_cells.value_or(options.certify ? search.max_cells : unasked_cells);
  return search;
}

void add_search(Json& document, const SearchResult& result) {
  document["evaluated"] = result.evaluated;
  document["abandoned"] = result.abandoned;
  Json optima = Json::array();
  for (const DirectionOptimum& optimum : result.optima)
    optima.push_back({{"direction", to_json(optimum.direction)}, {"stackability", optimum.stackability}});
  document["optima"] = optima;
  if (!result.bound) return;
  document["bound"] = result.bound->bound;
  document["accuracy"] = result.bound->accuracy;
  document["proven"] = result.bound->proven;
  document["cells"] = result.bound->cells;
  document["open_cells"] = result.bound->open;
}

/// A bound stays one in the five digits that are printed.
double rounded_up(double bound) {
  const double digits = std::abs(bound) < 1 ? 1e5 : 1e4;
  return std::ceil(bound * digits) / digits;
}

/// What is known of all directions.
void add_bound(TextTable& table, const DirectionBound& bound) {
  const std::string cells =
      counted(bound.cells, "cell") + " of directions examined, " + std::to_string(bound.open) + " left open";
  table.add(bound.proven ? "Proven" : "Bound", stackability_text(rounded_up(bound.bound)),
            bound.proven ? "nowhere above this; " + cells
                         : "nowhere above, but more than " + shortest_text(bound.accuracy) + " above S; " +
                               cells + ": more --max-cells close the gap");
}

std::string search_text(const SearchResult& result) {
  TextTable table;
  table.add("Directions tried", std::to_string(result.evaluated),
            std::to_string(result.abandoned) + " of them given up, too far below the best");
  if (result.bound) add_bound(table, *result.bound);
  for (std::size_t i = 1; i < std::min(result.optima.size(), listed_optima); ++i)
    table.add(i == 1 ? "Also good" : "", stackability_text(result.optima[i].stackability),
              "along " + vector_text(result.optima[i].direction));
  return table.text();
}

int run_search_command(const CLI::App& command, const SearchCommandOptions& options) {
  const Stopwatch watch;
  check_outputs(options.common, {{{"--picture", options.picture, OutputKind::picture}}});
  if (options.picture) require_rendering();
  const SearchOptions search = search_options(options);
  const ThreadLimit limit(options.common);
  const Model model = load_model(options.common);
  const StackabilitySolver solver =
      named(model, [&] { return StackabilitySolver(model.shape, options.stackability); });
  const SearchResult result =
      with_progress("Searching", options.common.caller, search,
                    [&](const SearchOptions& shown) { return best_direction(solver, shown); });
  const Measurement measurement = measure_exactly(solver, Direction(result.best.direction));

  Json document = document_head(command, model);
  add_measurement(document, measurement, model);
  add_search(document, result);
  add_document_tail(document, options.common, model, watch);
  if (options.picture)
    write_measurement_picture({*options.picture, title_of(model)}, model.shape, measurement);
  const std::string essential =
      exact_digits(measurement.values.value) + " " + vector_text(measurement.values.direction) + "\n";
  deliver(options.common, document,
          options.common.quiet ? essential : measurement_text(measurement, model) + search_text(result));
  return options.certify && !result.bound->proven ? status_no : status_done;
}

}  // namespace

Command make_search_command(CLI::App& program) {
  const auto options = std::make_shared<SearchCommandOptions>();
  CLI::App* const command =
      add_command(program, "search", "Find the direction along which a shape stacks best",
                  "stackabilize search chair.obj --cone-degrees 20 --direction 0 0 1");
  add_common_options(*command, options->common);
  add_semantics_option(*command, options->stackability.semantics);
  add_boxes_option(*command, options->stackability.boxes);
  add_number(*command,
             {"--cone-degrees", "Look only within this angle around --direction (default: everywhere)", 0,
              max_degrees, true},
             options->cone_degrees);
  add_direction(*command, "--direction", options->direction, "Axis of the cone (default: 0 0 1)");
  add_direction(*command, "--plane", options->plane, "Look only in the plane with this normal");
  add_number(
      *command,
      {"--certify",
       "Prove that no direction has an S larger by more than this (default: 0.001; status 1 where such "
       "a proof was asked for and fails)",
       0, 1, true},
      options->certify);
  add_count(
      *command,
      {"--max-cells",
       "Cells of directions to examine at most for that (default: 10000, with --certify 200000; 0: no proof)",
       0, max_cells_limit},
      options->max_cells);
  command
      ->add_option("--picture", options->picture,
                   "Draw the best direction's envelopes and contacts (.png or .svg)")
      ->type_name("FILE");
  return {command, [command, options] { return run_search_command(*command, *options); }, &options->common};
}

}  // namespace stackabilization::apps
