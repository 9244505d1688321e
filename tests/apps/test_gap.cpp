#include "apps/run_program.h"
#include "stackabilization/core/rational.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using namespace stackabilization::apps;
using nlohmann::json;

namespace {

/// A cube of side 1, and one half as high that floats above a corner of it.
struct CubesFolder : TemporaryFolder {
  std::string cube = model("cube.obj", solids::box({0, 0, 0}, {1, 1, 1}));
  std::string slab = model("slab.obj", solids::box({0.5, 0.5, 3.3}, {2, 2, 3.8}));
};

}  // namespace

TEST_CASE("the gap between two shapes is exact, signed, and has a witness") {
  const CubesFolder folder;
  const json apart = run_program({"gap", folder.cube, folder.slab, "--json", "-"}).json();
  CHECK(Rational(apart["exact"]["numerator"], apart["exact"]["denominator"]) ==
        Rational(3.3) - Rational(1.0));
  CHECK(apart["gap"].get<double>() == Approx(2.3).epsilon(1e-15));
  CHECK(apart["above"] == folder.slab);
  CHECK(apart["witness"]["point"][2] == 1);
  CHECK(apart["witness"]["lower_point"][2] == 3.3);
  // The other way round it has to be lifted out.
  CHECK(run_program({"gap", folder.slab, folder.cube, "--quiet"}).out == "-3.8\n");
  // Along a longer direction the gap is the same, and half as much of it.
  const json along =
      run_program({"gap", folder.cube, folder.slab, "--direction", "0", "0", "2", "--json", "-"}).json();
  CHECK(along["gap"] == apart["gap"]);
  // A copy comes down from f_max to touch: its gap is minus f_max.
  CHECK(run_program({"gap", folder.cube, folder.cube, "--quiet"}).out == "-1\n");
}

TEST_CASE("the gradient of a gap has all places where the shapes touch") {
  const CubesFolder folder;
  const json gradient = run_program({"gap", folder.cube, folder.slab, "--json", "-"}).json()["gradient"];
  CHECK(gradient["complete"] == true);
  CHECK(gradient["one_plane_each"] == true);
  REQUIRE(gradient["touches"].size() >= 4);  // the corners of the square that both have in common
  for (const json& touch : gradient["touches"]) {
    CHECK(touch["triangles"].size() == 2);
    CHECK(touch["weights"].size() == 2);
    CHECK(touch["normal"] == json({0, 0, 1}));
    CHECK(touch["direction"] == json({0, 0, 0}));
  }
}

TEST_CASE("shapes that pass each other have no gap, unless touching counts") {
  const TemporaryFolder folder;
  const std::string cube = folder.model("cube.obj", solids::box({0, 0, 0}, {1, 1, 1}));
  const std::string beside = folder.model("beside.obj", solids::box({1, 0, 5}, {2, 1, 6}));
  const Outcome none = run_program({"gap", cube, beside, "--json", "-"});
  CHECK(none.status == 0);
  CHECK(none.json()["gap"].is_null());
  CHECK(none.json()["witness"].is_null());
  CHECK(none.json()["gradient"].is_null());
  CHECK(run_program({"gap", cube, beside, "--quiet"}).out == "none\n");
  CHECK(run_program({"gap", cube, beside}).out.find("pass each other") != std::string::npos);
  CHECK(run_program({"gap", cube, beside, "--semantics", "closed", "--quiet"}).out == "4\n");
}

TEST_CASE("a gap is not told between units that differ, or without a second shape") {
  const CubesFolder folder;
  Shape other = solids::box({1, 1, 1});
  other.unit = Unit::millimetre;
  const std::string in_mm = folder.model("mm.3mf", other);
  check_refused(folder, {"gap", folder.cube, in_mm}, 2,
                "MODEL is in an unknown unit and ABOVE is in mm: give --unit, which holds for both");
  check_refused(folder, {"gap", folder.cube}, 2, "ABOVE");
  check_refused(folder, {"gap", folder.cube, folder / "missing.obj"}, 3, "missing.obj");
  check_refused(folder, {"gap", "-", "-"}, 2, "cannot both be standard input");
}
