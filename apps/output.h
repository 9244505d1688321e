#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/common_options.h"
#include "apps/json.h"

namespace stackabilization::apps {

/// What kind of file an output option names.
enum class OutputKind { text, mesh, picture, project };

/// An output as asked for on the command line.
struct OutputRequest {
  std::string option;               ///< as typed, "--json"
  std::optional<std::string> path;  ///< nothing: not asked for; "-": standard output
  OutputKind kind = OutputKind::text;
};

/// A file that the command reads.
struct InputFile {
  std::string what;  ///< "the model"
  std::string path;
};

/// Fails before a long computation instead of after it: throws UsageError when two outputs name one file, an
/// output would replace the model, its labels or one of `further_inputs`, or an extension is not one that can
/// be written, and OutputError when the folder of a file is missing or closed to us. The JSON of `common` is
/// checked too.
void check_outputs(const CommonOptions& common, const std::vector<OutputRequest>& requests = {},
                   const std::vector<InputFile>& further_inputs = {});

/// Prints `text`, or writes it to a file, whole or not at all. Throws OutputError.
void write_output(const std::string& path, std::string_view text);

/// Writes a mesh file in the format of its extension, and unless quiet says on standard error which unit a
/// shape without one gets by it. Throws OutputError.
void write_mesh_output(const CommonOptions& common, const std::string& path, const Shape& shape);

/// The last step of every command: the JSON where asked for, then `text` on standard output unless the JSON
/// is there.
void deliver(const CommonOptions& common, const Json& document, const std::string& text);

}  // namespace stackabilization::apps
