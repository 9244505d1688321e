#include <algorithm>

#include "apps/run_program.h"
#include "stackabilization/core/rational.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using namespace stackabilization::apps;
using nlohmann::json;

namespace {

/// A step of heights 1 and 2, and a cube of side 1 that floats beside it.
struct StepFolder : TemporaryFolder {
  std::string step =
      model("step.obj", concatenate(solids::box({0, 0, 0}, {2, 2, 1}), solids::box({2, 0, 0}, {4, 2, 2})));
  std::string cube = model("cube.obj", solids::box({2.5, 0.5, 7}, {3.5, 1.5, 8}));
};

}  // namespace

TEST_CASE("a cube drops at its place, and at the best one onto the lower half of a step") {
  const StepFolder folder;
  const json given = run_program({"drop", folder.cube, "--onto", folder.step, "--json", "-"}).json();
  CHECK(given["height"] == 2);
  CHECK(given["lift"] == -5);
  CHECK(given["place"]["x"] == 3);
  CHECK_FALSE(given.contains("bound"));
  const Outcome best = run_program(
      {"drop", folder.cube, "--onto", folder.step, "--place", "best", "--eps", "0.01", "--json", "-"});
  CHECK(best.status == 0);
  CHECK(best.json()["height"] == 1);
  CHECK(best.json()["proven"] == true);
  CHECK(best.json()["bound"].get<double>() >= 0.99);
  // Only on the higher half.
  const json high = run_program({"drop", folder.cube, "--onto", folder.step, "--place", "best", "--corner",
                                 "2.6", "0.5", "--corner", "3.4", "0.5", "--corner", "3", "1", "--json", "-"})
                        .json();
  CHECK(high["height"] == 2);
}

TEST_CASE(
    "a plate longer than a step leaves the least space on its whole length, and the least gap on half of "
    "it") {
  const StepFolder folder;
  // Over x from 1 to 4 it rests on the higher half, with 1 of 3 above the lower one, 1 deep.
  const std::string plate = folder.model("plate.obj", solids::box({0, 0, 7}, {3, 2, 8}));
  const auto placed = [&](const std::string& least) {
    return run_program(
               {"drop", plate, "--onto", folder.step, "--place", "best", "--least", least, "--json", "-"})
        .json();
  };
  const json volume = placed("volume");
  CHECK(volume["least"] == "volume");
  CHECK(volume["height"] == 2);
  CHECK(volume["footprint"]["low"].get<double>() <= 6);
  CHECK(volume["footprint"]["high"].get<double>() == Approx(6).epsilon(1e-3));
  CHECK(volume["volume"]["low"].get<double>() <= 2 + 1e-9);
  CHECK(volume["volume"]["high"].get<double>() >= 2 - 1e-9);
  CHECK(volume["mean_depth"]["high"].get<double>() == Approx(1.0 / 3).margin(0.01));
  CHECK(volume["bound"].get<double>() <= 1.0 / 3 + 1e-9);
  CHECK(volume["proven"] == true);
  const json gap = placed("gap");
  CHECK(gap["mean_gap"]["high"].get<double>() == Approx(1.0 / 3).margin(0.01));
  CHECK(gap["min_overlap"] == 0.5);
  // Beyond the end nothing is below.
  const json beyond =
      run_program({"drop", plate, "--onto", folder.step, "--place", "best", "--least", "gap", "--corner",
                   "2.5", "1", "--corner", "3.5", "1", "--corner", "3.5", "1.1", "--json", "-"})
          .json();
  CHECK(beyond["mean_gap"]["high"].get<double>() <= 0.01);
  CHECK(beyond["place"]["x"].get<double>() >= 3.5 - 0.02);
}

TEST_CASE("too few cells are not enough for a proof: status 1, and a bound that holds") {
  const StepFolder folder;
  const Outcome few = run_program({"drop", folder.cube, "--onto", folder.step, "--place", "best", "--turn",
                                   "--max-cells", "1", "--eps", "0.000001", "--json", "-"});
  CHECK(few.json()["bound"].get<double>() <= few.json()["height"].get<double>());
  CHECK(few.status == (few.json()["proven"] == true ? 0 : 1));
}

TEST_CASE("the map of a drop has a row for every place") {
  const StepFolder folder;
  const std::string map = folder / "map.csv";
  CHECK(run_program({"drop", folder.cube, "--onto", folder.step, "--map", map, "--step", "0.5"}).status == 0);
  const std::string text = bytes_of(map);
  CHECK(text.starts_with("x,y,height\n0.5,0.5,1\n1,0.5,1\n1.5,0.5,1\n2,0.5,2\n"));
  CHECK(std::count(text.begin(), text.end(), '\n') == 1 + 7 * 3);
}

TEST_CASE("a drop is refused where options or units do not fit") {
  const StepFolder folder;
  check_refused(folder, {"drop", folder.cube}, 2, "--onto");
  check_refused(folder, {"drop", folder.cube, "--onto", folder.step, "--turn"}, 2, "needs --place best");
  check_refused(folder, {"drop", folder.cube, "--onto", folder.step, "--place", "best", "--corner", "1", "2"},
                2, "three times at least");
  check_refused(folder, {"drop", folder.cube, "--onto", folder.step, "--least", "gap"}, 2,
                "needs --place best");
  check_refused(folder, {"drop", folder.cube, "--onto", folder.step, "--place", "best", "--overlap", "0.3"},
                2, "needs --least gap");
  check_refused(folder,
                {"drop", folder.cube, "--onto", folder.step, "--place", "best", "--least", "gap", "--corner",
                 "9", "9", "--corner", "9", "10", "--corner", "10", "9"},
                2, "over as large an area");
  Shape wall = solids::box({1, 1, 1});
  wall.vertices.col(0).setZero();
  check_refused(
      folder,
      {"drop", folder.model("wall.obj", wall), "--onto", folder.step, "--place", "best", "--least", "volume"},
      3, "wall.obj: the shape has no area");
  check_refused(folder, {"drop", folder.cube, "--onto", folder.step, "--step", "1"}, 2, "needs --map");
  check_refused(folder, {"drop", folder.cube, "--onto", folder / "missing.obj"}, 3, "missing.obj");
  Shape other = solids::box({1, 1, 1});
  other.unit = Unit::millimetre;
  check_refused(folder, {"drop", folder.cube, "--onto", folder.model("mm.3mf", other)}, 2,
                "in an unknown unit");
}
