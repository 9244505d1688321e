#include <cmath>
#include <string>

#include "apps/run_program.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;
using namespace stackabilization::apps;
using nlohmann::json;

namespace {

/// A cup whose walls widen by 1 over 8 and lie against each other in a stack.
Shape tapered_cup() {
  return solids::named(solids::frustum_shell({.inner_bottom = 2.5625, .inner_top = 3.5}), "cup");
}

}  // namespace

TEST_CASE("hold says how a stack of cups stands and jams") {
  const TemporaryFolder folder;
  const std::string cup = folder.model("cup.obj", tapered_cup());
  const json held = run_program({"hold", cup, "-n", "4", "--friction", "0.2", "--json", "-"}).json();
  CHECK(held["n"] == 4);
  CHECK(held["friction"] == 0.2);
  CHECK(held["stands"] == true);
  CHECK(held["needed_friction"] == 0);
  CHECK(held["lean_degrees"] == 0);
  CHECK(held["centring_slope"].get<double>() == Approx(8));
  const double draft = std::atan(std::cos(3.14159265358979 / 64) / 8);
  CHECK(held["jams"] == true);
  CHECK(held["jammed_upper_part"] == "cup");
  CHECK(held["pull_off"].get<double>() ==
        Approx((0.2 * std::cos(draft) - std::sin(draft)) / (0.2 * std::cos(draft) + std::sin(draft))));
  CHECK(held["contacts"].size() >= 1);
  const std::string text = run_program({"hold", cup, "--friction", "0.2"}).out;
  CHECK(text.find("'cup' on itself") != std::string::npos);
  CHECK(text.find("all around") != std::string::npos);
  CHECK(run_program({"hold", cup, "--friction", "0.1", "--json", "-"}).json()["jams"] == false);
}

TEST_CASE("hold answers no where a stack does not stand, and says what is missing") {
  const TemporaryFolder folder;
  // Blocks on a slope of 0.25, which they leave without that much friction.
  const std::string block =
      folder.model("block.obj", solids::extruded_profile({{0, 0}, {4, 1}, {4, 2}, {0, 1}}, 3));
  const Outcome slides = run_program({"hold", block, "--friction", "0.2", "--json", "-"});
  CHECK(slides.status == 1);
  CHECK(slides.json()["needed_friction"].get<double>() == Approx(0.25).epsilon(1e-5));
  CHECK(slides.json()["centring_slope"].get<double>() == Approx(-0.25));
  // Cubes along a leaning direction drift by a quarter of an edge each: the fourth is beside the first.
  const std::string cube = folder.model("cube.obj", solids::box(Eigen::Vector3d(2, 2, 2)));
  const json leaning =
      run_program({"hold", cube, "-n", "3", "--direction", "1", "0", "4", "--json", "-"}).json();
  CHECK(leaning["lean_degrees"].get<double>() == Approx(std::atan(0.25) * 180 / 3.14159265358979));
  CHECK(leaning["drift"].get<double>() == Approx(1));
  CHECK(leaning["stands"] == true);
  CHECK(run_program({"hold", cube, "-n", "5", "--direction", "1", "0", "4"}).status == 1);
  CHECK(std::stod(run_program({"hold", cube, "--quiet", "--friction", "2"}).out) ==
        Approx(std::atan(0.5) * 180 / 3.14159265358979));
}

TEST_CASE("hold refuses what makes no stack") {
  const TemporaryFolder folder;
  const std::string cube = folder.model("cube.obj", solids::box(Eigen::Vector3d(2, 2, 2)));
  check_refused(folder, {"hold", cube, "-n", "1"}, 2, "-n");
  check_refused(folder, {"hold", cube, "--friction", "-0.1"}, 2, "--friction");
  check_refused(folder, {"hold", cube, "--friction", "101"}, 2, "--friction");
  check_refused(folder, {"hold", cube, "--side-gap", "-1"}, 2, "--side-gap");
  check_refused(folder, {"hold", cube, "--direction", "0", "0", "0"}, 2, "--direction");
}
