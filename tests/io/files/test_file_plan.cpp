#include <fstream>

#include "stackabilization/core/errors.h"
#include "stackabilization/io/file_plan.h"
#include "stackabilization/io/write_file.h"
#include "support/catch.h"

using namespace stackabilization;

namespace {

namespace fs = std::filesystem;

struct Folder {
  Folder() {
    std::string name = (fs::temp_directory_path() / "stackabilization-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()));
    path = name;
  }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  fs::path file(const std::string& name) const {
    std::ofstream(path / name) << name;
    return path / name;
  }

  fs::path path;
};

}  // namespace

TEST_CASE("a plan takes every file below a folder for read, and a folder by its names alone") {
  const Folder folder;
  fs::create_directories(folder.path / "in/deep");
  const fs::path deep = folder.file("in/deep/table.csv");
  fs::create_directory(folder.path / "out");
  const auto plan = [&](const fs::path& filled) {
    FilePlan result;
    result.reads_all("the data", folder.path / "in");
    result.fills("-o", filled, [](const std::string& name) { return name.ends_with(".csv"); });
    return result;
  };
  CHECK_NOTHROW(plan(folder.path / "out").check());
  CHECK_NOTHROW(plan(folder.path / "new/er").check());
  CHECK_THROWS_AS(plan(folder.path / "in/deep").check(), UsageError);
  CHECK_NOTHROW(plan(folder.path / "in").check());
  fs::create_hard_link(deep, folder.path / "out/other.csv");
  CHECK_THROWS_AS(plan(folder.path / "out").check(), UsageError);
  fs::rename(folder.path / "out/other.csv", folder.path / "out/other.txt");
  CHECK_NOTHROW(plan(folder.path / "out").check());
}

TEST_CASE("a plan does not touch anything") {
  const Folder folder;
  FilePlan plan;
  plan.reads("the model", folder.file("model"));
  plan.writes("--json", folder.path / "out.json");
  plan.fills("-o", folder.path / "new", [](const std::string&) { return true; });
  plan.check();
  CHECK(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()) == 1);
  CHECK_THROWS_AS(plan.writes("--picture", ""), UsageError);
  for (const char* path : {"", "-"})
    CHECK_THROWS_AS(plan.fills("-o", path, [](const std::string&) { return true; }), UsageError);
}

TEST_CASE("what links lead to is followed to the end, be it there or not") {
  const Folder folder;
  fs::create_symlink("b", folder.path / "a");
  fs::create_symlink(folder.path / "c", folder.path / "b");
  CHECK(steps_of_links(folder.path / "a") ==
        std::vector<fs::path>{folder.path / "a", folder.path / "b", folder.path / "c"});
  CHECK(steps_of_links("-") == std::vector<fs::path>{"-"});
  write_file_atomically(folder.path / "a", "text");
  CHECK(fs::is_symlink(folder.path / "a"));
  CHECK(fs::file_size(folder.path / "c") == 4);
  fs::create_symlink("round", folder.path / "round");
  CHECK(fs::is_symlink(steps_of_links(folder.path / "round").back()));
  CHECK_THROWS_AS(write_file_atomically(folder.path / "round", "text"), OutputError);
}
