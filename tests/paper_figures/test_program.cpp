#include <algorithm>

#include "apps/run_program.h"
#include "support/catch.h"

using namespace stackabilization::apps;

namespace {

void check_refused(const std::vector<std::string>& arguments, int status, const std::string& words) {
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
  check_refused({}, 2, "--figure, --all, --list or --page");
  check_refused({"--figure", "2"}, 2, "-o");
  check_refused({"--figure", "2", "--all", "-o", folder / "out"}, 2, "exclude");
  check_refused({"--figure", "two", "-o", folder / "out"}, 2, "two");
  check_refused({"--figure", "77", "-o", folder / "out"}, 2, "there is no figure 77");
  check_refused({"--frobnicate"}, 2, "frobnicate");
  CHECK(folder.names().empty());
}

TEST_CASE("folders that are missing or closed are one sentence") {
  const TemporaryFolder folder;
  check_refused({"--figure", "2", "-o", folder / "out", "--models", folder / "nowhere"}, 3, "nowhere");
  check_refused({"--figure", "2", "-o", folder / "out", "--paper-data", folder / "nowhere"}, 3, "nowhere");
  check_refused({"--figure", "2", "-o", folder / "out", "--inputs", folder / "nowhere"}, 3, "nowhere");
  check_refused({"--figure", "2", "-o", folder.file("file", "") + "/out"}, 2, "cannot be made");
  check_refused({"--page", folder / "page.md", "-o", folder / "empty"}, 3, "no figures");
}
