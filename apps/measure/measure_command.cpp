#include <memory>

#include "apps/common/command.h"
#include "apps/common/measurement.h"
#include "apps/common/output.h"
#include "apps/common/rendering.h"
#include "apps/common/values.h"
#include "stackabilization/envelope/height_field.h"

namespace stackabilization::apps {

namespace {

struct MeasureCommandOptions {
  CommonOptions common;
  std::optional<Eigen::Vector3d> direction;
  Method method = Method::exact;
  int resolution = 1024;
  StackabilityOptions stackability;
  std::optional<Length> layer;
  std::optional<std::string> picture;
};

std::string essential_measurement(const Stackability& values) {
  return (values.box_volume > 0 ? exact_digits(values.value) : "undefined") + "\n";
}

int run_measure_command(const CLI::App& command, const MeasureCommandOptions& options) {
  const Stopwatch watch;
  check_outputs(options.common, {{{"--picture", options.picture, OutputKind::picture}}});
  refuse_option(options.layer && options.method != Method::exact, "--layer", "needs --method exact");
  if (options.picture || options.method == Method::gl_raster) require_rendering();
  const Direction direction(options.direction.value_or(Eigen::Vector3d::UnitZ()));
  const ThreadLimit limit(options.common);
  const Model model = load_model(options.common);
  const StackabilitySolver solver =
      named(model, [&] { return StackabilitySolver(model.shape, options.stackability); });
  if (options.picture && !(solver.box_volume() > 0))
    throw InputError(display_name(model) + ": the shape is flat, and --picture draws shapes with volume");
  Measurement measurement = options.method == Method::exact
                                ? measure_exactly(solver, direction)
                                : measure_by_sampling(solver, direction, options.method, options.resolution);
  if (options.layer)
    measurement.layer =
        measure_layer(solver, measurement, options.layer->in(model.shape.unit), options.resolution);

  Json document = document_head(command, model);
  add_measurement(document, measurement, model);
  add_document_tail(document, options.common, model, watch);
  if (options.picture)
    write_measurement_picture({*options.picture, title_of(model)}, model.shape, measurement);
  deliver(options.common, document,
          options.common.quiet ? essential_measurement(measurement.values)
                               : measurement_text(measurement, model));
  return status_done;
}

}  // namespace

Command make_measure_command(CLI::App& program) {
  const auto options = std::make_shared<MeasureCommandOptions>();
  options->stackability.flat_shapes = FlatShapes::measure;
  CLI::App* const command =
      add_command(program, "measure", "Measure how well a shape stacks along one direction",
                  "stackabilize measure chair.obj --direction 0 0 1 --picture chair.png");
  add_common_options(*command, options->common);
  add_direction(*command, "--direction", options->direction,
                "Stacking direction, exact doubles (default: 0 0 1)");
  const Choices<Method> methods = {{"exact", Method::exact},
                                   {"rays", Method::rays},
                                   {"raster", Method::raster},
                                   {"gl-raster", Method::gl_raster}};
  add_choice(*command, "--method", options->method, methods,
             "How f_max is found; all but exact sample the surface (default: exact)");
  add_count(*command, {"--resolution", "Samples along the longer side (default: 1024)", 1, max_resolution},
            options->resolution);
  add_semantics_option(*command, options->stackability.semantics);
  add_boxes_option(*command, options->stackability.boxes);
  add_length(*command,
             {"--layer", "Say how much of a copy lies within this of the one below when they touch", true},
             options->layer);
  command->add_option("--picture", options->picture, "Draw envelopes, contacts and gap (.png or .svg)")
      ->type_name("FILE");
  return {command, [command, options] { return run_measure_command(*command, *options); }, &options->common};
}

}  // namespace stackabilization::apps
