#include "apps/resumed_run.h"
#include "support/catch.h"

using namespace stackabilization::apps;

namespace {

std::filesystem::path shipped(const std::string& name) {
  return std::filesystem::path(STACKABILIZATION_SOURCE_DIR) / "data" / "models" / (name + ".obj");
}

}  // namespace

TEST_CASE("a run in pieces ends with the files of a run at once, directions looked for") {
  check_resumed({shipped("mug_with_handle"), {"--target", "0.9", "--effort", "0.2"}});
  check_resumed({shipped("basket"), {"--target", "0.6", "--effort", "0.1", "--preset", "paper"}});
}
