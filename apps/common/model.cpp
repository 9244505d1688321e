#include "apps/common/model.h"

#include <filesystem>

#include "apps/common/caller.h"
#include "apps/common/version.h"

namespace stackabilization::apps {

std::string display_name(const Model& model) {
  return model.name == "-" ? "standard input" : model.name;
}

std::string title_of(const Model& model) {
  return std::filesystem::path(display_name(model)).filename().string();
}

namespace {

/// A mesh of the caller, with the unit that is asked for; nothing: MODEL is a file.
std::optional<Shape> shape_of_caller(const CommonOptions& common) {
  if (!common.caller) return std::nullopt;
  const auto found = common.caller->meshes.find(common.model);
  if (found == common.caller->meshes.end()) return std::nullopt;
  const ReadOptions& read = common.read;
  if (read.format || read.up || read.labels)
    throw UsageError("--format, --up and --labels say how a file is read, and " + common.model +
                     " is a mesh in memory");
  Shape shape = *found->second;
  if (read.unit) shape.unit = *read.unit;
  try {
    validate(shape);
  } catch (const InputError& error) {
    throw InputError(common.model + ": " + error.what());
  }
  return shape;
}

}  // namespace

void check_unit(const CommonOptions& common, const Shape& shape) {
  if (common.to_unit && shape.unit == Unit::unknown)
    throw UsageError("--to-unit needs a model whose unit is known: say it with --unit");
}

Model load_model(const CommonOptions& common, const InspectOptions& options) {
  Model model;
  model.name = common.model;
  std::optional<Shape> in_memory = shape_of_caller(common);
  model.shape = in_memory ? std::move(*in_memory) : read_shape(common.model, common.read);
  check_unit(common, model.shape);
  model.findings = inspect(model.shape, options);
  return model;
}

Model load_other_model(CommonOptions common, const std::string& path) {
  common.model = path;
  common.read.labels.reset();
  common.read.format.reset();
  return load_model(common);
}

void check_same_unit(const Model& model, const Model& other, const std::string& name_of_other) {
  const auto words = [](Unit unit) { return unit == Unit::unknown ? "an unknown unit" : unit_symbol(unit); };
  const Unit a = model.shape.unit, b = other.shape.unit;
  if (a != b)
    throw UsageError("MODEL is in " + words(a) + " and " + name_of_other + " is in " + words(b) +
                     ": give --unit, which holds for both");
}

Json document_head(const std::string& command, const Model& model) {
  return {{"command", command},
          {"version", version_number()},
          {"model", model.name},
          {"unit", to_json(model.shape.unit)}};
}

Json document_head(const CLI::App& command, const Model& model) {
  return document_head(command.get_name(), model);
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
