#include <sstream>

#include "apps/run_program.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;
using namespace stackabilization::apps;
using nlohmann::json;

namespace {

/// A seat over a bar: 16 are undercut, 8 on each. The walls are 10 x 4 and 2 x (8 + 1).
Shape seat_over_bar() {
  const Shape seat = solids::named(solids::box({0, 0, 5}, {10, 10, 6}), "seat");
  Shape both = concatenate(seat, solids::named(solids::box({1, 4, 2}, {9, 5, 3}), "bar"));
  both.unit = Unit::millimetre;
  return both;
}

}  // namespace

TEST_CASE("draft says what is undercut, of the whole and of each part") {
  const TemporaryFolder folder;
  const std::string model = folder.model("stool.3mf", seat_over_bar());
  const json whole = run_program({"draft", model, "--json", "-"}).json();
  CHECK(whole["direction"] == json({0, 0, 1}));
  CHECK(whole["complete"] == true);
  CHECK(whole["area"].get<double>() == Approx(240 + 34));
  CHECK(whole["undercut_area"].get<double>() == Approx(16).epsilon(1e-6));
  CHECK(whole["little_draft_area"].get<double>() == Approx(40 + 18));
  CHECK(whole["inner_area"] == 0);
  CHECK(whole["min_draft_degrees"] == 0);
  REQUIRE(whole["parts"].size() == 2);
  CHECK(whole["parts"][1]["name"] == "bar");
  CHECK(whole["parts"][1]["area"].get<double>() == Approx(34));
  CHECK(whole["parts"][1]["undercut_area"].get<double>() == Approx(8).epsilon(1e-6));
  // Along x the bar lies beside the seat, with nothing before or behind it.
  const json across = run_program({"draft", model, "--direction", "1", "0", "0", "--json", "-"}).json();
  CHECK(across["undercut_area"] == 0);
}

TEST_CASE("draft says in words what holds a shape in its mould") {
  const TemporaryFolder folder;
  const std::string model = folder.model("stool.3mf", seat_over_bar());
  const std::string text = run_program({"draft", model}).out;
  CHECK(text.find("16 mm^2, 5.8 %") != std::string::npos);
  CHECK(text.find("bar ") != std::string::npos);
  const std::string cup = folder.model("cup.obj", solids::frustum_shell({}));
  CHECK(run_program({"draft", cup, "--quiet"}).out == "0\n");
  CHECK(run_program({"draft", cup}).out.find("nothing holds the object") != std::string::npos);
  const json cup_draft = run_program({"draft", cup, "--draft-degrees", "7.2", "--json", "-"}).json();
  CHECK(cup_draft["min_draft_degrees"].get<double>() == Approx(7.1).margin(0.05));
  CHECK(cup_draft["little_draft_area"].get<double>() > 0);
  CHECK(run_program({"draft", cup, "--draft-degrees", "7", "--json", "-"}).json()["little_draft_area"] == 0);
}

TEST_CASE("the table of draft has a line per triangle, which add up") {
  const TemporaryFolder folder;
  const std::string model = folder.model("stool.obj", seat_over_bar());
  std::istringstream table(run_program({"draft", model, "-o", "-"}).out);
  std::string line;
  std::getline(table, line);
  CHECK(line == "triangle,draft_degrees,area,undercut_area,inner_area");
  int rows = 0;
  double undercut = 0;
  for (; std::getline(table, line); ++rows) {
    std::istringstream row(line);
    std::array<double, 5> values{};
    char comma = 0;
    for (double& value : values) row >> value >> comma;
    CHECK(values[0] == rows);
    undercut += values[3];
  }
  CHECK(rows == 24);
  CHECK(undercut == Approx(16).epsilon(1e-6));
}

TEST_CASE("draft refuses what is no draft angle or direction") {
  const TemporaryFolder folder;
  const std::string model = folder.model("stool.obj", seat_over_bar());
  check_refused(folder, {"draft", model, "--draft-degrees", "91"}, 2, "--draft-degrees");
  check_refused(folder, {"draft", model, "--draft-degrees", "-1"}, 2, "--draft-degrees");
  check_refused(folder, {"draft", model, "--direction", "0", "0", "0"}, 2, "--direction");
  check_refused(folder, {"draft", model, "-o", model}, 2, "would replace");
}
