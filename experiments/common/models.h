#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization::experiments {

/// A mesh file and how tables call it, in the same way on every machine.
struct ModelFile {
  std::filesystem::path path;
  std::string name;      ///< stem of the file; in the authors' data the path below that folder
  bool authors = false;  ///< one of the authors' models: its pictures may not be passed on
};

/// The models that this project ships, by name. Throws InputError when there are none.
std::vector<ModelFile> shipped_models();

/// All OBJ files of the authors' data, by path. Throws InputError, naming the folder, when it is missing or
/// holds none.
std::vector<ModelFile> paper_models(const std::filesystem::path& folder);

/// Files below a folder with this extension, by path. Throws InputError when the folder cannot be read or
/// a name is not UTF-8.
std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder,
                                               const std::string& extension);

}  // namespace stackabilization::experiments
