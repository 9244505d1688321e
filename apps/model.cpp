#include "apps/model.h"

#include <filesystem>

#include "apps/version.h"

namespace stackabilization::apps {

std::string display_name(const Model& model) {
  return model.name == "-" ? "standard input" : model.name;
}

std::string title_of(const Model& model) {
  return std::filesystem::path(display_name(model)).filename().string();
}

Model load_model(const CommonOptions& common, const InspectOptions& options) {
  Model model;
  model.name = common.model;
  model.shape = read_shape(common.model, common.read);
  model.findings = inspect(model.shape, options);
  return model;
}

Json document_head(const CLI::App& command, const Model& model) {
  return {{"command", command.get_name()},
          {"version", version_number},
          {"model", model.name},
          {"unit", to_json(model.shape.unit)}};
}

void add_document_tail(Json& document, const CommonOptions& common, const Model& model,
                       const Stopwatch& watch) {
  document["findings"] = to_json(model.findings);
  if (!common.no_timing) document["seconds"] = watch.seconds();
}

void add_model_line(TextTable& table, const Model& model) {
  table.add("Model", display_name(model) + ": " + brief(model.findings));
}

}  // namespace stackabilization::apps
