#include <algorithm>

#include "apps/run_program.h"
#include "support/catch.h"

using namespace stackabilization::apps;

namespace {

void check_refused_by_program(const std::vector<std::string>& arguments, int status,
                              const std::string& words) {
  const Outcome outcome = run_program(arguments);
  INFO(outcome.err);
  CHECK(outcome.status == status);
  CHECK(outcome.err.starts_with("paper_figures: "));
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  CHECK(outcome.err.find(words) != std::string::npos);
}

}  // namespace

TEST_CASE("the program lists its figures and shows examples") {
  const Outcome list = run_program({"--list"});
  CHECK(list.status == 0);
  CHECK(list.out.find("2  Envelopes") != std::string::npos);
  const Outcome help = run_program({"--help"});
  CHECK(help.status == 0);
  CHECK(help.out.find("paper_figures --figure 5 -o out/figures") != std::string::npos);
}

TEST_CASE("wrong usage is one sentence") {
  const TemporaryFolder folder;
  check_refused_by_program({}, 2, "--figure, --all, --list or --page");
  check_refused_by_program({"--figure", "2"}, 2, "-o");
  check_refused_by_program({"--figure", "2", "--all", "-o", folder / "out"}, 2, "exclude");
  check_refused_by_program({"--figure", "two", "-o", folder / "out"}, 2, "two");
  check_refused_by_program({"--figure", "77", "-o", folder / "out"}, 2, "there is no figure 77");
  check_refused_by_program({"--frobnicate"}, 2, "frobnicate");
  CHECK(folder.names().empty());
}

TEST_CASE("no picture or page takes the place of an input") {
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  const std::string source = STACKABILIZATION_SOURCE_DIR;
  fs::copy(source + "/data/models", folder / "models");
  fs::create_directory(folder / "inputs");
  fs::create_directory(folder / "out");
  for (const auto& entry : fs::directory_iterator(source + "/paper_figures"))
    if (entry.path().extension() == ".json") fs::copy(entry.path(), folder / "inputs");
  const std::vector<std::string> line = {
      "--figure", "2", "--inputs", folder / "inputs", "--models", folder / "models", "-o", folder / "out"};
  const auto paged = [&](const std::string& page) {
    std::vector<std::string> arguments = line;
    arguments.insert(arguments.end(), {"--page", page});
    return arguments;
  };
  check_refused_by_program(paged(folder / "models/cup.obj"), 2, "--page would replace the model");
  check_refused_by_program(paged(folder / "inputs/figure_02.json"), 2, "--page would replace the input");
  check_refused_by_program(paged(folder / "out/figure_02.png"), 2, "would replace what --page writes");
  fs::create_symlink("../models/cup.obj", folder / "out/figure_02.png");
  check_refused_by_program(line, 2, "would replace");
  fs::remove(folder / "out/figure_02.png");
  fs::create_directory(folder / "out/timings.json");
  check_refused_by_program(line, 2, "it is a folder");
  check_refused_by_program({"--figure", "2", "-o", folder / "figures.md"}, 2, "called like a file");
}

TEST_CASE("folders that are missing or closed are one sentence") {
  const TemporaryFolder folder;
  check_refused_by_program({"--figure", "2", "-o", folder / "out", "--models", folder / "nowhere"}, 3,
                           "nowhere");
  check_refused_by_program({"--figure", "2", "-o", folder / "out", "--paper-data", folder / "nowhere"}, 3,
                           "nowhere");
  check_refused_by_program({"--figure", "2", "-o", folder / "out", "--inputs", folder / "nowhere"}, 3,
                           "nowhere");
  check_refused_by_program({"--figure", "2", "-o", folder.file("file", "") + "/out"}, 2, "is not a folder");
  check_refused_by_program({"--page", folder / "page.md", "-o", folder / "empty"}, 3, "no figures");
}
