#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/common/common_options.h"
#include "apps/common/json.h"
#include "apps/common/owned_folder.h"
#include "stackabilization/core/copies.h"

namespace stackabilization::apps {

/// What kind of file an output option names.
enum class OutputKind { text, mesh, picture, project };

/// An output as asked for on the command line.
struct OutputRequest {
  std::string option;               ///< as typed, "--json"
  std::optional<std::string> path;  ///< nothing: not asked for; "-": standard output
  OutputKind kind = OutputKind::text;
  bool updates_model = false;  ///< MODEL is read, and then replaced by what was made of it
};

/// A file that the command reads.
struct InputFile {
  std::string what;  ///< "the model"
  std::string path;
};

/// A folder that the command fills.
struct FolderRequest {
  std::string option;  ///< as typed, "--pictures"
  OwnedFolder folder;
};

/// What a command reads and writes, besides what `CommonOptions` names.
struct CommandFiles {
  std::vector<OutputRequest> outputs = {};
  std::vector<InputFile> inputs = {};
  std::optional<FolderRequest> folder = {};
};

/// The one door for files: fails before a long computation instead of after it, with nothing written. Throws
/// UsageError when an extension is not one that can be written, and what FilePlan::check throws when an
/// output would replace MODEL, its labels, a file that they refer to, one of the inputs or another output, or
/// cannot be written; OutputError when a file that is not ours is in the way in the folder. The JSON of
/// `common` and standard output are among the outputs.
void check_outputs(const CommonOptions& common, const CommandFiles& files = {});

/// Prints `text`, or writes it to a file, whole or not at all. Throws OutputError.
void write_output(const std::string& path, std::string_view text);

/// The same for a text that an option asks for: a caller gets it instead.
void write_text_output(const CommonOptions& common, const std::string& path, const std::string& text);

/// Writes a mesh file in the format of its extension, and unless quiet says on standard error which unit a
/// shape without one gets by it. Throws OutputError. A caller gets the shape instead.
void write_mesh_output(const CommonOptions& common, const std::string& path, const Shape& shape);
/// The same for copies of a shape. A caller knows their places from the document, and gets none.
void write_mesh_output(const CommonOptions& common, const std::string& path, const Copies& copies);

/// The last step of every command: the JSON where asked for, then `text` on standard output unless the JSON
/// is there. Unless quiet, a sentence follows that says in which unit lengths were read that were typed
/// without one: `unit` of the document. A caller gets the JSON alone.
void deliver(const CommonOptions& common, const Json& document, const std::string& text);

}  // namespace stackabilization::apps
