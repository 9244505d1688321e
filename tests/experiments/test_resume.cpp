#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "common/resume.h"
#include "support/catch.h"

using namespace stackabilization::experiments;
namespace fs = std::filesystem;

namespace {

void write(const fs::path& path, const std::string& text) {
  std::ofstream(path) << text;
}

/// A results folder with a program, an input and the outputs of a run.
struct Fixture {
  fs::path folder = fs::temp_directory_path() / ("experiments_resume_" + std::to_string(getpid()));
  Job job{"ruler", folder / "program", {"--directions", "3"}, {folder / "input.obj"}};

  Fixture() {
    fs::remove_all(folder);
    fs::create_directories(folder);
    write(folder / "program", "binary");
    write(folder / "input.obj", "v 0 0 0");
    write(folder / "ruler.csv", "1,2");
    write(folder / "ruler_summary.csv", "3,4");
    write(folder / "ruler.log", "words");
    write(folder / "rulers.csv", "of another");
  }
  ~Fixture() {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
  Fixture(const Fixture&) = delete;
  Fixture& operator=(const Fixture&) = delete;
};

}  // namespace

TEST_CASE("a job that was recorded is complete, with its status, and one that was not is not") {
  const Fixture f;
  CHECK_FALSE(completed(f.job, f.folder));
  record_completed(f.job, 0, f.folder);
  CHECK(completed(f.job, f.folder) == 0);
  record_completed(f.job, 1, f.folder);
  CHECK(completed(f.job, f.folder) == 1);
}

TEST_CASE("anything that numbers depend on makes a job incomplete") {
  Fixture f;
  record_completed(f.job, 0, f.folder);
  SECTION("the program") {
    write(f.folder / "program", "binary of another revision");
  }
  SECTION("an option") {
    f.job.arguments = {"--directions", "4"};
  }
  SECTION("a further option") {
    f.job.arguments.emplace_back("--seeds");
  }
  SECTION("the bytes of an input") {
    write(f.folder / "input.obj", "v 0 0 1");
  }
  SECTION("a further input") {
    write(f.folder / "more.obj", "v 1 1 1");
    f.job.inputs.push_back(f.folder / "more.obj");
  }
  CHECK_FALSE(completed(f.job, f.folder));
}

TEST_CASE("outputs that were changed, lost or added make a job incomplete") {
  const Fixture f;
  record_completed(f.job, 0, f.folder);
  SECTION("changed") {
    write(f.folder / "ruler_summary.csv", "3,5");
  }
  SECTION("lost") {
    fs::remove(f.folder / "ruler.csv");
  }
  SECTION("added") {
    write(f.folder / "ruler.json", "{}");
  }
  CHECK_FALSE(completed(f.job, f.folder));
}

TEST_CASE("logs and the outputs of other jobs do not count") {
  const Fixture f;
  record_completed(f.job, 0, f.folder);
  write(f.folder / "ruler.log", "other words");
  write(f.folder / "rulers.csv", "changed");
  CHECK(completed(f.job, f.folder) == 0);
}

TEST_CASE("a record that is cut off, or of nothing, counts for nothing") {
  const Fixture f;
  record_completed(f.job, 0, f.folder);
  SECTION("cut off") {
    fs::resize_file(f.folder / "ruler.done", 20);
  }
  SECTION("empty") {
    write(f.folder / "ruler.done", "");
  }
  SECTION("no object") {
    write(f.folder / "ruler.done", "[1]");
  }
  SECTION("of a run without outputs") {
    fs::remove(f.folder / "ruler.csv");
    fs::remove(f.folder / "ruler_summary.csv");
    record_completed(f.job, 0, f.folder);
  }
  CHECK_FALSE(completed(f.job, f.folder));
}

TEST_CASE("clearing forgets the job's own files only") {
  const Fixture f;
  record_completed(f.job, 0, f.folder);
  clear(f.job, f.folder);
  CHECK_FALSE(fs::exists(f.folder / "ruler.done"));
  CHECK_FALSE(fs::exists(f.folder / "ruler.csv"));
  CHECK_FALSE(fs::exists(f.folder / "ruler_summary.csv"));
  CHECK(fs::exists(f.folder / "rulers.csv"));
  CHECK(fs::exists(f.folder / "input.obj"));
}
