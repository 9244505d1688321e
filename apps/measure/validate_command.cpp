#include <memory>
#include <utility>

#include "apps/common/command.h"
#include "apps/common/model.h"
#include "apps/common/output.h"
#include "apps/common/rendering.h"
#include "apps/common/values.h"
#include "stackabilization/stacking/validation.h"

namespace stackabilization::apps {

namespace {

struct ValidateCommandOptions {
  CommonOptions common;
  std::optional<Eigen::Vector3d> direction;
};

Json row_json(const ValidationRow& row, bool timing) {
  Json json = {{"name", row.name},
               {"value", to_json(row.value)},
               {"error", to_json(row.error)},
               {"verdict", to_string(row.verdict)},
               {"note", row.note}};
  if (timing) json["seconds"] = row.seconds;
  return json;
}

Json separation_json(const Separation& separation) {
  if (!separation.blocked) return nullptr;
  return {{"f_max", separation.length},
          {"exact", to_json(separation.value)},
          {"witness", to_json(separation.witness)}};
}

void add_report(Json& document, const ValidationReport& report, bool timing) {
  document["direction"] = to_json(report.direction);
  document["height"] = report.extent;
  document["solid"] = separation_json(report.solid);
  document["closed"] = separation_json(report.closed);
  Json rows = Json::array();
  for (const ValidationRow& row : report.rows) rows.push_back(row_json(row, timing));
  document["checks"] = std::move(rows);
  document["passed"] = report.passed;
}

std::string report_text(const Model& model, const ValidationReport& report) {
  const Unit unit = model.shape.unit;
  TextTable heading;
  add_model_line(heading, model);
  heading.add("Direction", vector_text(report.direction));
  heading.add("Height", quantity(report.extent, unit), "of one copy along the direction");
  heading.add("Exact f_max", report.solid.blocked ? exact_digits(report.solid.length) : "none",
              "solid: smallest lift that sets a copy free, walls may slide");
  heading.add("", report.closed.blocked ? exact_digits(report.closed.length) : "none",
              "closed: touching counts");
  return heading.text() + "\n" + table(report);
}

/// The report, with the graphics card's raster among the checks where there is one, and a line that says so
/// where not.
ValidationReport validated(const Model& model, const Direction& direction) {
  ValidationOptions options;
  const DepthBufferMaker depth_buffer = depth_buffer_maker(model.shape);
  if (depth_buffer.maker) options.further_rasters.push_back(*depth_buffer.maker);
  ValidationReport report = validate_translation(model.shape, direction, options);
  if (!depth_buffer.maker) {
    ValidationRow row;
    row.name = depth_buffer_name;
    row.note = depth_buffer.reason;
    report.rows.push_back(row);
  }
  return report;
}

int run_validate_command(const CLI::App& command, const ValidateCommandOptions& options) {
  const Stopwatch watch;
  check_outputs(options.common);
  const Direction direction(options.direction.value_or(Eigen::Vector3d::UnitZ()));
  const ThreadLimit limit(options.common);
  const Model model = load_model(options.common);
  const ValidationReport report = validated(model, direction);

  Json document = document_head(command, model);
  add_report(document, report, !options.common.no_timing);
  add_document_tail(document, options.common, model, watch);
  const std::string verdict = report.passed ? "passed\n" : "failed\n";
  deliver(options.common, document, options.common.quiet ? verdict : report_text(model, report));
  return report.passed ? status_done : status_no;
}

}  // namespace

Command make_validate_command(CLI::App& program) {
  const auto options = std::make_shared<ValidateCommandOptions>();
  CLI::App* const command =
      add_command(program, "validate", "Check the exact f_max against methods that share nothing with it",
                  "stackabilize validate chair.obj --direction 0 0 1");
  add_common_options(*command, options->common);
  add_direction(*command, "--direction", options->direction, "Stacking direction (default: 0 0 1)");
  return {command, [command, options] { return run_validate_command(*command, *options); }, &options->common};
}

}  // namespace stackabilization::apps
