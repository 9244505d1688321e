#include <algorithm>
#include <memory>

#include "apps/common/command.h"
#include "apps/common/measurement.h"
#include "apps/common/output.h"
#include "apps/common/progress.h"
#include "apps/common/rendering.h"
#include "apps/common/values.h"
#include "stackabilization/core/direction_text.h"
#include "stackabilization/stacking/map.h"

namespace stackabilization::apps {

namespace {

struct MapCommandOptions {
  CommonOptions common;
  StackabilityOptions stackability;
  std::optional<double> step_degrees;
  std::optional<std::string> table;
  std::optional<std::string> picture;
};

constexpr double default_step_degrees = 2;

/// What a map comes down to.
struct Summary {
  MapSample best, worst;
  double mean = 0;  ///< every sample counts the same: they are spread evenly
};

Summary summary_of(const StackabilityMap& map) {
  const auto less = [](const MapSample& a, const MapSample& b) { return a.stackability < b.stackability; };
  Summary summary;
  summary.best = *std::max_element(map.samples.begin(), map.samples.end(), less);
  summary.worst = *std::min_element(map.samples.begin(), map.samples.end(), less);
  for (const MapSample& sample : map.samples) summary.mean += sample.stackability;
  summary.mean /= static_cast<double>(map.samples.size());
  return summary;
}

std::string csv_text(const StackabilityMap& map) {
  std::string text = "theta_degrees,phi_degrees,x,y,z,f_max_over_height,stackability\n";
  for (const MapSample& sample : map.samples) {
    for (const double value : {sample.theta, sample.phi, sample.direction.x(), sample.direction.y(),
                               sample.direction.z(), sample.f_max_over_height})
      text += exact_digits(value) + ",";
    text += exact_digits(sample.stackability) + "\n";
  }
  return text;
}

Json sample_json(const MapSample& sample) {
  return {{"direction", to_json(sample.direction)},
          {"theta_degrees", sample.theta},
          {"phi_degrees", sample.phi},
          {"f_max_over_height", sample.f_max_over_height},
          {"stackability", sample.stackability}};
}

Json map_json(const MapCommandOptions& options, const StackabilityMap& map, const Summary& summary) {
  return {{"semantics", name_of(options.stackability.semantics)},
          {"boxes", name_of(options.stackability.boxes)},
          {"step_degrees", map.step_degrees},
          {"directions", map.samples.size()},
          {"best", sample_json(summary.best)},
          {"worst", sample_json(summary.worst)},
          {"mean_stackability", summary.mean}};
}

std::string map_text(const Model& model, const StackabilityMap& map, const Summary& summary) {
  TextTable table;
  add_model_line(table, model);
  table.add(
      "Directions", std::to_string(map.samples.size()),
      exact_digits(map.step_degrees) + " degrees apart over the upper hemisphere; opposite ones stack alike");
  table.add("Best", stackability_text(summary.best.stackability), direction_text(summary.best.direction));
  table.add("Worst", stackability_text(summary.worst.stackability), direction_text(summary.worst.direction));
  table.add("Mean", stackability_text(summary.mean), "stackability: 1 saves all the space, 0 none");
  return table.text();
}

int run_map_command(const CLI::App& command, const MapCommandOptions& options) {
  const Stopwatch watch;
  check_outputs(options.common,
                {{{"--output", options.table}, {"--picture", options.picture, OutputKind::picture}}});
  if (options.picture) require_rendering();
  const ThreadLimit limit(options.common);
  const Model model = load_model(options.common);
  const StackabilitySolver solver =
      named(model, [&] { return StackabilitySolver(model.shape, options.stackability); });
  MapOptions mapping;
  mapping.step_degrees = options.step_degrees.value_or(default_step_degrees);
  const StackabilityMap map =
      with_progress("Mapping", options.common.caller, mapping,
                    [&](const MapOptions& shown) { return stackability_map(solver, shown); });
  const Summary summary = summary_of(map);

  Json document = document_head(command, model);
  document.update(map_json(options, map, summary));
  add_document_tail(document, options.common, model, watch);
  if (options.picture) write_map_picture({*options.picture, title_of(model)}, map);
  if (options.table) write_text_output(options.common, *options.table, csv_text(map));
  const std::string essential =
      exact_digits(summary.best.stackability) + " " + vector_text(summary.best.direction) + "\n";
  const std::string text = options.common.quiet ? essential : map_text(model, map, summary);
  deliver(options.common, document, options.table == "-" ? "" : text);
  return status_done;
}

}  // namespace

Command make_map_command(CLI::App& program) {
  const auto options = std::make_shared<MapCommandOptions>();
  CLI::App* const command =
      add_command(program, "map", "Measure the stackability along every direction",
                  "stackabilize map chair.obj --step-degrees 2 -o chair.csv --picture chair.svg");
  add_common_options(*command, options->common);
  add_number(*command,
             {"--step-degrees", "Angle between directions, from 0.1 to 90 (default: 2)", 0.1, max_degrees},
             options->step_degrees);
  add_semantics_option(*command, options->stackability.semantics);
  add_boxes_option(*command, options->stackability.boxes);
  command
      ->add_option("-o,--output", options->table, "Write a table, one line per direction (CSV; - is stdout)")
      ->type_name("FILE");
  command->add_option("--picture", options->picture, "Draw the map of the hemisphere (.png or .svg)")
      ->type_name("FILE");
  return {command, [command, options] { return run_map_command(*command, *options); }, &options->common};
}

}  // namespace stackabilization::apps
