#include "apps/common/output.h"

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "apps/common/caller.h"
#include "apps/common/interrupt.h"
#include "apps/common/text.h"
#include "apps/common/values.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/units.h"
#include "stackabilization/io/companion_files.h"
#include "stackabilization/io/file_plan.h"
#include "stackabilization/io/format.h"
#include "stackabilization/io/write.h"
#include "stackabilization/io/write_file.h"

namespace stackabilization::apps {

namespace {

void check_kind(const OutputRequest& request) {
  const std::filesystem::path path = *request.path;
  if (request.kind == OutputKind::mesh) {
    if (path == "-")
      throw UsageError(request.option + " needs a file name: a mesh is not written to standard output");
    try {
      format_of_extension(path);
    } catch (const InputError&) {
      throw UsageError(request.option + " expects a file name ending in one of " +
                       std::string(writable_extensions()) + ", found '" + path.string() + "'");
    }
  }
  if (request.kind == OutputKind::project && path != "-" && path.extension() != ".json")
    throw UsageError(request.option + " expects a file name ending in .json, found '" + path.string() + "'");
  if (request.kind == OutputKind::picture && path.extension() != ".png" && path.extension() != ".svg")
    throw UsageError(request.option + " expects a file name ending in .png or .svg, found '" + path.string() +
                     "'");
}

/// The unit in which readers of a format take numbers of an unknown unit; unknown: none.
Unit unit_by_format(Format format) {
  if (format == Format::three_mf) return Unit::millimetre;
  return format == Format::gltf ? Unit::metre : Unit::unknown;
}

/// A mesh file and what it refers to.
void add_mesh(FilePlan& plan, const std::string& what, const std::string& path, const ReadOptions& read) {
  plan.reads(what, path);
  for (const std::filesystem::path& companion : companion_files(path, read.format))
    plan.reads("a file of " + what + ",", companion);
}

}  // namespace

void check_outputs(const CommonOptions& common, const CommandFiles& files) {
  if (common.caller) return;  // nothing is written
  FilePlan plan;
  add_mesh(plan, "the model", common.model, common.read);
  if (common.read.labels) plan.reads("the labels", *common.read.labels);
  for (const InputFile& input : files.inputs) add_mesh(plan, input.what, input.path, {});
  std::vector<OutputRequest> asked = {{"--json", common.json, OutputKind::text}};
  asked.insert(asked.end(), files.outputs.begin(), files.outputs.end());
  std::erase_if(asked, [](const OutputRequest& request) { return !request.path; });
  const bool writes_mesh = std::any_of(asked.begin(), asked.end(),
                                       [](const auto& request) { return request.kind == OutputKind::mesh; });
  if (common.to_unit && !writes_mesh) throw UsageError("--to-unit needs --output, a mesh to write");
  bool prints = true;
  for (const OutputRequest& request : asked) {
    if (request.updates_model)
      plan.updates(request.option, *request.path);
    else
      plan.writes(request.option, *request.path);
    prints = prints && *request.path != "-";
  }
  if (prints) plan.writes("standard output", "-");
  if (files.folder)
    plan.fills(files.folder->option, files.folder->folder.path(),
               [&](const std::string& name) { return files.folder->folder.is_written(name); });
  plan.check();
  for (const OutputRequest& request : asked) check_kind(request);
  if (files.folder) files.folder->folder.check();
}

void write_output(const std::string& path, std::string_view text) {
  const DeferredInterrupts until_written;
  write_file_atomically(path, text);
  if (until_written.requested()) throw Interrupted();
}

void write_text_output(const CommonOptions& common, const std::string& path, const std::string& text) {
  if (common.caller)
    common.caller->written_texts[path] = text;
  else
    write_output(path, text);
}

namespace {

/// `mesh` is a Shape or Copies.
template <class Mesh>
void write_mesh(const CommonOptions& common, const std::string& path, const Mesh& mesh) {
  const DeferredInterrupts until_written;
  if (common.to_unit)
    write_shape(in_unit(mesh, *common.to_unit), path);
  else
    write_shape(mesh, path);
  if (until_written.requested()) throw Interrupted();
}

void say_unit(const CommonOptions& common, const std::string& path, Unit unit) {
  const Unit taken = unit == Unit::unknown ? unit_by_format(format_of_extension(path)) : Unit::unknown;
  if (taken == Unit::unknown || common.quiet) return;
  std::cerr << "stackabilize: the unit of the model is not known, so its numbers count as " +
                   unit_symbol(taken) + " in " + path + ": say which unit they have with --unit\n";
}

}  // namespace

void write_mesh_output(const CommonOptions& common, const std::string& path, const Shape& shape) {
  if (common.caller) {
    common.caller->written_meshes[path] = shape;
    return;
  }
  write_mesh(common, path, shape);
  say_unit(common, path, shape.unit);
}

void write_mesh_output(const CommonOptions& common, const std::string& path, const Copies& copies) {
  if (common.caller) return;
  write_mesh(common, path, copies);
  say_unit(common, path, copies.shapes.front().unit);
}

namespace {

/// Options with lengths above 0 that were typed without a unit: "--clearance 0.5".
std::vector<std::string> lengths_without_unit(const CLI::App& command) {
  std::vector<std::string> lengths;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_type_name() != "LENGTH") continue;
    for (const std::string& text : option->results()) {
      const Length length = parse_length({option->get_name(), ""}, text);
      if (length.unit == Unit::unknown && length.value > 0)
        lengths.push_back(option->get_name() + " " + text);
    }
  }
  return lengths;
}

/// The sentence of a report that says in which unit lengths were read that have none.
std::string unit_sentence(const CommonOptions& common, const Json& document) {
  if (!common.command) return "";
  const std::vector<std::string> lengths = lengths_without_unit(*common.command);
  if (lengths.empty()) return "";
  std::string unit = "that of each model";
  if (const auto found = document.find("unit"); found != document.end())
    unit = found->is_null() ? "that of the model, which is unknown"
                            : found->get<std::string>() + ", the unit of the model";
  return "Lengths without a unit are in " + unit + ": " + joined(lengths) + "\n";
}

}  // namespace

void deliver(const CommonOptions& common, const Json& document, const std::string& text) {
  if (common.caller) {
    common.caller->document = document;
    return;
  }
  if (common.json) write_output(*common.json, json_text(document));
  if (common.json_on_stdout()) return;
  const bool is_report = !common.quiet && !text.empty();
  write_output("-", is_report ? text + unit_sentence(common, document) : text);
}

}  // namespace stackabilization::apps
