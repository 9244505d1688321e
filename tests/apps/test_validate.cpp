#include <cmath>

#include "apps/run_program.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using namespace stackabilization::apps;
using nlohmann::json;

TEST_CASE("validate holds the exact value against every other method") {
  const TemporaryFolder folder;
  const std::string model = folder.model("l.obj", solids::l_shape(3, 1));
  const Outcome outcome = run_program({"validate", model, "--direction", "1", "0", "1", "--json", "-"});
  CHECK(outcome.status == 0);
  const json result = outcome.json();
  CHECK(result["passed"] == true);
  CHECK(result["solid"]["f_max"].get<double>() == Approx(std::sqrt(2.0)).epsilon(1e-12));
  CHECK(result["checks"].size() >= 5);
  for (const json& check : result["checks"]) {
    CHECK(check["verdict"] != "DISAGREES");
    CHECK(check.contains("seconds"));
  }
}

TEST_CASE("validate prints a table and, quietly, a verdict") {
  const TemporaryFolder folder;
  const std::string model = folder.model("box.obj", solids::box({1, 2, 3}));
  const Outcome table = run_program({"validate", model});
  CHECK(table.status == 0);
  CHECK(table.out.find("verdict") != std::string::npos);
  CHECK(run_program({"validate", model, "--quiet"}).out == "passed\n");
}
