#include <algorithm>
#include <cmath>
#include <sstream>

#include "apps/run_program.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using namespace stackabilization::apps;
using nlohmann::json;

namespace {

/// Of few triangles: a search measures it thousands of times.
Shape square_cup() {
  solids::FrustumShell cup;
  cup.segments = 4;
  return solids::frustum_shell(cup);
}

}  // namespace

TEST_CASE("search finds the axis of a cup and reports what measure reports there") {
  const TemporaryFolder folder;
  const std::string model = folder.model("cup.obj", square_cup());
  const Outcome outcome = run_program({"search", model, "--cone-degrees", "5", "--json", "-"});
  REQUIRE(outcome.status == 0);
  const json found = outcome.json();
  const json measured = run_program({"measure", model, "--json", "-"}).json();
  CHECK(found["stackability"].get<double>() >= measured["stackability"].get<double>() - 1e-9);
  CHECK(std::abs(found["direction"][2].get<double>()) == Approx(1).epsilon(1e-6));
  for (const auto& [key, value] : measured.items()) CHECK(found.contains(key));
  CHECK(found["evaluated"].get<int>() > 0);
  CHECK(found["abandoned"].get<int>() <= found["evaluated"].get<int>());
  REQUIRE(!found["optima"].empty());
  CHECK(found["optima"][0]["direction"] == found["direction"]);
}

TEST_CASE("search stays inside its cone and its plane") {
  const TemporaryFolder folder;
  const std::string model = folder.model("cup.obj", solids::frustum_shell({}));
  const json cone =
      run_program({"search", model, "--cone-degrees", "10", "--direction", "1", "0", "0", "--json", "-"})
          .json();
  CHECK(std::abs(cone["direction"][0].get<double>()) >= std::cos(10.001 * 3.14159265358979 / 180));
  const json plane = run_program({"search", model, "--plane", "0", "0", "1", "--json", "-"}).json();
  CHECK(std::abs(plane["direction"][2].get<double>()) < 1e-8);
}

TEST_CASE("map lists every direction of the hemisphere and sums them up") {
  const TemporaryFolder folder;
  const std::string model = folder.model("cup.obj", solids::frustum_shell({}));
  const std::string table = folder / "map.csv";
  const Outcome outcome = run_program({"map", model, "--step-degrees", "30", "-o", table, "--json", "-"});
  REQUIRE(outcome.status == 0);
  const json summary = outcome.json();
  CHECK(summary["step_degrees"] == 30);

  std::istringstream lines(bytes_of(table));
  std::string line;
  std::getline(lines, line);
  CHECK(line == "theta_degrees,phi_degrees,x,y,z,f_max_over_height,stackability");
  double best = -1e300, sum = 0;
  int count = 0;
  while (std::getline(lines, line)) {
    const double value = std::stod(line.substr(line.rfind(',') + 1));
    best = std::max(best, value);
    sum += value;
    ++count;
  }
  CHECK(summary["directions"] == count);
  CHECK(summary["best"]["stackability"] == best);
  CHECK(summary["mean_stackability"].get<double>() == Approx(sum / count));
  CHECK(summary["best"]["direction"] == json({0, 0, 1}));
}

TEST_CASE("map writes its table to standard output, and then nothing else") {
  const TemporaryFolder folder;
  const std::string model = folder.model("box.obj", solids::box({1, 2, 3}));
  const Outcome outcome = run_program({"map", model, "--step-degrees", "45", "-o", "-"});
  CHECK(outcome.status == 0);
  CHECK(outcome.out.starts_with("theta_degrees,"));
  CHECK(outcome.out.find("Model") == std::string::npos);
}
