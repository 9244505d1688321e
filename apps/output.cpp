#include "apps/output.h"

#include <unistd.h>

#include <filesystem>
#include <iostream>

#include "apps/interrupt.h"
#include "stackabilization/shape/errors.h"
#include "stackabilization/shape/format.h"
#include "stackabilization/shape/write.h"
#include "stackabilization/shape/write_file.h"

namespace stackabilization::apps {

namespace {

bool same_file(const std::string& a, const std::string& b) {
  if (a == b) return true;
  if (a == "-" || b == "-") return false;
  std::error_code error;
  if (std::filesystem::equivalent(a, b, error)) return true;
  const auto normal = [](const std::string& path) {
    return std::filesystem::absolute(path).lexically_normal();
  };
  return normal(a) == normal(b);
}

/// Pipes and devices swallow any number of outputs.
bool is_device(const std::string& path) {
  std::error_code error;
  return path != "-" && std::filesystem::is_other(std::filesystem::status(path, error));
}

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

void check_place(const OutputRequest& request) {
  const std::filesystem::path path = *request.path;
  if (path == "-") return;
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw OutputError(path.string() + " cannot be written: it is a folder");
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error)) return;
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (!std::filesystem::is_directory(folder, error))
    throw OutputError(path.string() + " cannot be written: there is no folder " + folder.string());
  if (access(folder.c_str(), W_OK) != 0)
    throw OutputError(path.string() + " cannot be written: the folder " + folder.string() +
                      " is write-protected");
}

/// The unit in which readers of a format take numbers of an unknown unit; unknown: none.
Unit unit_by_format(Format format) {
  if (format == Format::three_mf) return Unit::millimetre;
  return format == Format::gltf ? Unit::metre : Unit::unknown;
}

/// An output may go where the input came from when that is a terminal or a pipe.
void check_against_inputs(const OutputRequest& request, const std::vector<InputFile>& inputs) {
  const std::string& path = *request.path;
  if (path == "-" || is_device(path)) return;
  for (const InputFile& input : inputs)
    if (same_file(path, input.path))
      throw UsageError(request.option + " would replace " + input.what + " " + input.path);
}

}  // namespace

void check_outputs(const CommonOptions& common, const std::vector<OutputRequest>& requests,
                   const std::vector<InputFile>& further_inputs) {
  std::vector<InputFile> inputs = {{"the model", common.model}};
  if (common.read.labels) inputs.push_back({"the labels", common.read.labels->string()});
  inputs.insert(inputs.end(), further_inputs.begin(), further_inputs.end());
  std::vector<OutputRequest> asked = {{"--json", common.json, OutputKind::text}};
  asked.insert(asked.end(), requests.begin(), requests.end());
  std::erase_if(asked, [](const OutputRequest& request) { return !request.path; });
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const std::string& path = *asked[i].path;
    if (path.empty()) throw UsageError(asked[i].option + " expects a file name, found an empty one");
    check_against_inputs(asked[i], inputs);
    for (std::size_t j = 0; j < i; ++j)
      if (!is_device(path) && same_file(path, *asked[j].path))
        throw UsageError(asked[j].option + " and " + asked[i].option + " name the same output, " + path);
    check_kind(asked[i]);
    check_place(asked[i]);
  }
}

void write_output(const std::string& path, std::string_view text) {
  const DeferredInterrupts until_written;
  write_file_atomically(path, text);
  if (until_written.requested()) throw Interrupted();
}

void write_mesh_output(const CommonOptions& common, const std::string& path, const Shape& shape) {
  const DeferredInterrupts until_written;
  write_shape(shape, path);
  if (until_written.requested()) throw Interrupted();
  const Unit taken = shape.unit == Unit::unknown ? unit_by_format(format_of_extension(path)) : Unit::unknown;
  if (taken == Unit::unknown || common.quiet) return;
  std::cerr << "stackabilize: the unit of the model is not known, so its numbers count as " +
                   unit_symbol(taken) + " in " + path + ": say which unit they have with --unit\n";
}

void deliver(const CommonOptions& common, const Json& document, const std::string& text) {
  if (common.json) write_output(*common.json, json_text(document));
  if (!common.json_on_stdout()) write_output("-", text);
}

}  // namespace stackabilization::apps
