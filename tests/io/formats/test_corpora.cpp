#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <vector>

#include "stackabilization/io/inspect.h"
#include "support/catch.h"
#include "support/meshes.h"

using namespace stackabilization;
using namespace stackabilization::test;

namespace {

const std::vector<std::string> extensions = {".obj", ".off", ".ply", ".stl", ".3mf", ".glb", ".gltf"};

/// Mesh files below a folder of the corpora, sorted; nothing when the corpora are not there.
std::vector<std::filesystem::path> mesh_files(const std::string& folder) {
  const char* const root = std::getenv("STACKABILIZATION_CORPORA");
  if (!root) {
    std::cout << "SKIPPED: STACKABILIZATION_CORPORA does not name the folder of the corpora\n";
    return {};
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(std::filesystem::path(root) / folder)) {
    std::string extension = entry.path().extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return std::tolower(c); });
    if (std::find(extensions.begin(), extensions.end(), extension) != extensions.end())
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Files of the test meshes that cannot be used, and why.
const std::vector<std::pair<std::string, std::string>> refused = {
    {"empty.obj", "no faces"},
    {"empty.ply", "no faces"},
    {"obj_empty.obj", "no faces"},
    {"obj_points.obj", "points but no faces"},
    {"ply_empty_ascii.ply", "no faces"},
    {"ply_points_bin.ply", "points but no faces"},
    {"stl_empty_bin.stl", "no faces"},
    {"notenoughindices.obj", ":9: expected a face with at least three corners, found 2"},
    {"points_ascii.ply", "points but no faces"},
    {"points_ascii_with_lists.ply", "points but no faces"},
};

}  // namespace

TEST_CASE("every nasty file reads or is refused with the reason that fits it") {
  for (const std::filesystem::path& path : mesh_files("nasty")) {
    std::string message;
    try {
      const Shape shape = read_shape(path);
      CHECK_NOTHROW(validate(shape));
      CHECK_NOTHROW(inspect(shape));
    } catch (const InputError& error) {
      message = error.what();
    }
    INFO(path.string() << ": " << message);
    const auto expected = std::find_if(refused.begin(), refused.end(), [&](const auto& entry) {
      return entry.first == path.filename().string();
    });
    CHECK((expected == refused.end()) == message.empty());
    if (expected != refused.end()) CHECK(message.find(expected->second) != std::string::npos);
  }
}

TEST_CASE("furniture reads with its parts") {
  for (const std::filesystem::path& path : mesh_files("ikea")) {
    INFO(path.string());
    const Shape shape = read_shape(path);
    CHECK(shape.part_count() > 1);
    CHECK(same_shape(round_trip(shape, Format::obj), shape));
  }
}
