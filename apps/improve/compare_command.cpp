#include <algorithm>
#include <memory>
#include <optional>

#include "apps/common/command.h"
#include "apps/common/explanation_report.h"
#include "apps/common/output.h"
#include "apps/common/requirement_options.h"
#include "apps/common/structured_model.h"
#include "apps/common/values.h"

namespace stackabilization::apps {

namespace {

struct CompareCommandOptions {
  CommonOptions common;
  AnalysisArguments analysis;
  std::string after;
  std::optional<Axis> after_up;
  std::vector<std::string> relaxed;
};

/// The changed object with the parts of the one at rest. Throws InputError unless its triangles are the same.
Shape changed_shape(const CompareCommandOptions& options, const Model& rest) {
  CommonOptions reading = options.common;
  if (options.after_up) reading.read.up = options.after_up;
  const Model after = load_other_model(reading, options.after);
  Shape now = rest.shape;
  if (after.shape.vertex_count() != now.vertex_count() || after.shape.triangles != now.triangles)
    throw InputError(display_name(after) + ": expected the triangles of " + display_name(rest) +
                     ", which has " + std::to_string(now.vertex_count()) + " vertices and " +
                     std::to_string(now.triangle_count()) + " triangles, in their order; found " +
                     std::to_string(after.shape.vertex_count()) + " and " +
                     std::to_string(after.shape.triangle_count()) + ", or others");
  now.vertices = after.shape.vertices;
  return now;
}

Json quality_json(const std::vector<QualityValue>& values, const QualityLimits& limits, const Shape& shape) {
  const auto part = [&](int row) {
    return row < 0 ? Json(nullptr) : Json(shape.part_names.at(static_cast<std::size_t>(row)));
  };
  Json list = Json::array();
  for (const QualityValue& value : values)
    list.push_back({{"name", name_of(value.measure)},
                    {"value", value.value},
                    {"limit", limits.is_limited(value.measure) ? Json(limits[value.measure]) : Json(nullptr)},
                    {"unit", unit_of(value.measure)},
                    {"kept", is_within(value, limits)},
                    {"part", part(value.part)},
                    {"other", part(value.other)}});
  return list;
}

std::string quality_text(const std::vector<QualityValue>& values, const QualityLimits& limits,
                         const Shape& shape) {
  ColumnTable table({"measure", "value", "limit", "", "where"});
  for (const QualityValue& value : values) {
    std::string where;
    for (const int row : {value.part, value.other})
      if (row >= 0)
        where += (where.empty() ? "" : " and ") + shape.part_names.at(static_cast<std::size_t>(row));
    const bool limited = limits.is_limited(value.measure);
    table.add({name_of(value.measure), rounded(value.value),
               limited ? rounded(limits[value.measure]) : "none",
               unit_of(value.measure) + (is_within(value, limits) ? "" : ", NOT kept"), where});
  }
  return table.text();
}

int run_compare_command(const CLI::App& command, const CompareCommandOptions& options) {
  const Stopwatch watch;
  std::vector<InputFile> inputs = analysis_inputs(options.analysis);
  inputs.push_back({"AFTER", options.after});
  check_outputs(options.common, {{}, inputs});
  const QualityLimits limits = quality_limits_of(options.relaxed);
  const ThreadLimit limit(options.common);
  const StructuredModel rest = load_structured(command, options.common, options.analysis);
  const Shape now = changed_shape(options, rest.model);
  const std::vector<QualityValue> values =
      named(rest.model, [&] { return QualityMeter(rest.structured).measure(now); });
  const bool acceptable = std::all_of(values.begin(), values.end(),
                                      [&](const QualityValue& value) { return is_within(value, limits); });

  Json document = document_head(command, rest.model);
  document["after"] = options.after;
  document["acceptable"] = acceptable;
  const Explanation explanation = explain(rest.structured, now);
  document["explanation"] = explanation_json(explanation, now.part_names);
  document["quality"] = quality_json(values, limits, now);
  add_document_tail(document, options.common, rest.model, watch);
  const std::string answer = acceptable ? "acceptable\n" : "not acceptable\n";
  TextTable head;
  add_model_line(head, rest.model);
  head.add("After", options.after);
  const std::vector<std::string> words = explanation_lines(explanation);
  for (std::size_t i = 0; i < words.size(); ++i) head.add(i == 0 ? "Changes" : "", words[i]);
  deliver(options.common, document,
          options.common.quiet
              ? answer
              : head.text() + "\n" + quality_text(values, limits, now) + "\nThe change is " + answer);
  return acceptable ? status_done : status_no;
}

}  // namespace

Command make_compare_command(CLI::App& program) {
  const auto options = std::make_shared<CompareCommandOptions>();
  CLI::App* const command =
      add_command(program, "compare", "Say what a person would mind in a changed shape",
                  "stackabilize compare chair.obj improved/solution_1.obj --relax size=0.7");
  add_common_options(*command, options->common);
  command->add_option("AFTER", options->after, "Mesh file of the same triangles with other vertices")
      ->type_name("FILE")
      ->required();
  add_choice(*command, "--after-up", options->after_up, axis_choices(),
             "Axis of AFTER that points up (default: as --up); improve and deform write z");
  add_relax_option(*command, options->relaxed);
  add_analysis_options(*command, options->analysis);
  return {command, [command, options] { return run_compare_command(*command, *options); }, &options->common};
}

}  // namespace stackabilization::apps
