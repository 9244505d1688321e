#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "apps/common/json.h"
#include "stackabilization/core/shape.h"

namespace stackabilization::apps {

/// Another program that runs a command inside of its own process, as the Python module does. Its meshes and
/// projects are in memory, and so is what the command writes; there is no terminal, and signals are its own
/// business.
struct Caller {
  /// By names that MODEL, --into, ABOVE and AFTER may have.
  std::map<std::string, std::shared_ptr<const Shape>> meshes = {};
  std::map<std::string, std::string> projects = {};  ///< texts of project files, by names that MODEL may have
  /// Told from the calling thread which step goes on and how far it is, in [0, 1].
  std::function<void(const std::string& step, double fraction)> progress = {};
  /// Told from the calling thread of every design that `improve` finds, as soon as it is found.
  std::function<void(const Json& solution, const Shape& shape)> found = {};
  /// Asked from any thread; true ends the command, which throws Interrupted.
  std::function<bool()> stopped = {};

  Json document = {};                                     ///< what --json writes
  std::map<std::string, Shape> written_meshes = {};       ///< by what the options for meshes were given
  std::map<std::string, std::string> written_texts = {};  ///< the same for tables, graphs and projects
};

}  // namespace stackabilization::apps
