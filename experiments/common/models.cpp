#include "common/models.h"

#include <algorithm>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/utf8.h"

namespace stackabilization::experiments {

namespace fs = std::filesystem;

std::vector<fs::path> files_below(const fs::path& folder, const std::string& extension) {
  std::error_code error;
  std::vector<fs::path> files;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (it->path().extension() == extension) files.push_back(it->path());
  if (error) throw InputError(folder.string() + ": " + error.message());
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files)
    if (!is_utf8(file.string()))
      throw InputError(folder.string() + ": expected file names in UTF-8, found one that is not");
  return files;
}

std::vector<ModelFile> shipped_models() {
  const fs::path folder = STACKABILIZATION_MODELS_FOLDER;
  std::vector<ModelFile> models;
  for (const fs::path& path : files_below(folder, ".obj")) models.push_back({path, path.stem().string()});
  if (models.empty()) throw InputError(folder.string() + ": expected mesh files (.obj) in this folder");
  return models;
}

std::vector<ModelFile> paper_models(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw InputError(folder.string() + ": no such folder, expected that of the authors' data");
  std::vector<ModelFile> models;
  for (const fs::path& path : files_below(folder, ".obj"))
    models.push_back({path, path.lexically_relative(folder).replace_extension().generic_string(), true});
  if (models.empty())
    throw InputError(folder.string() + ": expected the authors' mesh files (.obj) below it");
  return models;
}

}  // namespace stackabilization::experiments
