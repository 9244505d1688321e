#include "apps/resumed_run.h"

#include "support/catch.h"

namespace stackabilization::apps {

Arguments ResumableTask::into(const std::string& folder, const Arguments& further) const {
  return joined(joined({"improve", model.string(), "--no-pictures", "--quiet", "-o", folder}, options),
                further);
}

void check_resumed(const ResumableTask& task) {
  INFO(task.model.string());
  const TemporaryFolder folder;
  const std::string whole = folder / "whole", pieces = folder / "pieces";
  const Outcome at_once = run_program(task.into(whole, {}));
  INFO(at_once.err);
  if (at_once.status > 1) {  // not a model for this
    CHECK(is_one_sentence(at_once.err));
    return;
  }
  CHECK(run_program(task.into(pieces, {"--expansions", "1"})).status <= 1);
  const Outcome stopped =
      run_program(task.into(pieces, {"--resume"}), "", "timeout --foreground --preserve-status -s INT 3");
  CHECK((stopped.status == 130 || stopped.status == at_once.status));
  const Outcome resumed = run_program(task.into(pieces, {"--resume", "--expansions", "3"}));
  INFO(resumed.err);
  CHECK(resumed.status <= 1);
  CHECK(run_program(task.into(pieces, {"--resume"})).status == at_once.status);
  CHECK(contents(pieces) == contents(whole));
}

}  // namespace stackabilization::apps
