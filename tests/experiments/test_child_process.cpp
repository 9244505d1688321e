#include "apps/run_program.h"
#include "common/child_process.h"
#include "support/catch.h"

using namespace stackabilization;
using namespace stackabilization::experiments;
using apps::bytes_of;
using apps::TemporaryFolder;

namespace {

ChildOutcome shell(const TemporaryFolder& folder, const std::string& script, int max_processor_seconds = 0) {
  return run_child({{"/bin/sh", "-c", script}, folder / "log", max_processor_seconds});
}

}  // namespace

TEST_CASE("a child process gives its status and leaves its words in the log") {
  const TemporaryFolder folder;
  CHECK(shell(folder, "echo one; echo two >&2; exit 3").status == 3);
  CHECK(bytes_of(folder / "log") == "one\ntwo\n");
  CHECK(first_line(folder / "log") == "one");
  CHECK(first_line(folder / "nothing").empty());
  CHECK_FALSE(shell(folder, "exit 127").killed());
}

TEST_CASE("a child process that a signal ends has a status of 128 and more") {
  const TemporaryFolder folder;
  const ChildOutcome outcome = shell(folder, "kill -TERM $$");
  CHECK(outcome.status == 128 + 15);
  CHECK(outcome.killed());
}

TEST_CASE("a program that is not there ends with status 127") {
  const TemporaryFolder folder;
  CHECK(run_child({{folder / "nothing"}, folder / "log"}).status == 127);
}

TEST_CASE("a child process ends when it has used its processor time") {
  const TemporaryFolder folder;
  const ChildOutcome outcome = shell(folder, "while :; do :; done", 1);
  CHECK(outcome.status == 128 + 24);  // SIGXCPU
  // The kernel counts time up to the limit and time used in different ways, on a busy machine a tenth apart.
  CHECK(outcome.processor_seconds >= 0.5);
  CHECK(outcome.seconds >= outcome.processor_seconds);
}

TEST_CASE("the memory of a child process is what it held at most") {
  const TemporaryFolder folder;
  const double little = shell(folder, "true").megabytes;
  // Without a line end in it, all of the input is the last line.
  const double much = shell(folder, "head -c 80000000 /dev/zero | tail -n 1 >/dev/null").megabytes;
  CHECK(little > 0);
  CHECK(little < 40);
  CHECK(much > 80);
}
