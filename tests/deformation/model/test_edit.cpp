#include <cmath>
#include <numbers>
#include <string>

#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/edit.h"
#include "support/catch.h"

using namespace stackabilization;

TEST_CASE("edits are described by part, operation and amount") {
  const std::vector<std::string> names = {"seat", "leg"};
  CHECK(describe({{HandleKind::face, 1, 3}, Move{{0.125, 0, -2}}}, names) ==
        "move face +y of leg by (0.125, 0, -2)");
  CHECK(describe({{HandleKind::part, 0, 0}, Rotate{{0, 0, 1}, std::numbers::pi / 4}}, names) ==
        "rotate seat by 45 degrees about (0, 0, 1)");
  CHECK(describe({{HandleKind::section, 1, 7}, Scale{0.9, {}}}, names) ==
        "scale cross-section 7 of leg by 0.9");
  CHECK(describe({{HandleKind::shape, 0, 0}, Scale{2, Eigen::Vector3d(1, 0, 0)}}, names) ==
        "scale the shape by 2 along (1, 0, 0)");
  CHECK(describe({{HandleKind::shape, 0, 0}, Taper{0.9, {0, 0, -1}, Eigen::Vector3d(1, 0, 0)}}, names) ==
        "taper the shape by 0.9 towards (0, 0, -1) along (1, 0, 0)");
  CHECK(describe({{HandleKind::part, 1, 0}, Lean{{0.25, 0, 0}, {0, 0, -1}}}, names) ==
        "lean leg by (0.25, 0, 0) towards (0, 0, -1)");
  CHECK(describe({{HandleKind::section, 1, 7}, Scale{0.9, {}}, Falloff::linear}, names) ==
        "scale cross-section 7 of leg by 0.9, linearly");
  CHECK(describe({{HandleKind::section, 0, 0}, Move{{1, 0, 0}}, Falloff::linear}, names) ==
        "move cross-section 0 of seat by (1, 0, 0), linearly");
}

TEST_CASE("numbers in words are five digits of the largest, and nothing is less than nothing") {
  const auto moved = [](double x, double y, double z) {
    return describe({{HandleKind::part, 0, 0}, Move{{x, y, z}}}, {"seat"})
        .substr(std::string("move seat by ").size());
  };
  CHECK(moved(-0.0, 0.1, -0.0) == "(0, 0.1, 0)");
  CHECK(moved(0, 0, -0.0) == "(0, 0, 0)");
  CHECK(moved(-3.860572786445121e-09, -0.074159436623263, 0) == "(0, -0.074159, 0)");
  CHECK(moved(-0.04671887590379034, -8.551735074330742e-05, 5e-6) == "(-0.046719, -0.000086, 0.000005)");
  CHECK(moved(0.99999999999, 1e-5, -1e-6) == "(1, 0.00001, 0)");
  CHECK(moved(123456.7, 0.5, -6) == "(123457, 0, -6)");
  CHECK(moved(120, 10, 1000) == "(120, 10, 1000)");
  CHECK(moved(1.25e30, -3e26, -1e20) == "(1.25e+30, -3e+26, 0)");
  CHECK(moved(4.94e-324, 0, 0) == "(4.9407e-324, 0, 0)");
  CHECK(describe({{HandleKind::section, 0, 7}, Scale{0.7290000000005826, {}}}, {"seat"}) ==
        "scale cross-section 7 of seat by 0.729");
}

TEST_CASE("the falloff is named where it means something") {
  const std::vector<std::string> names = {"seat"};
  CHECK(describe({{HandleKind::part, 0, 0}, Scale{0.5, {}}, Falloff::linear}, names) == "scale seat by 0.5");
  CHECK_FALSE(falls_off_linearly({{HandleKind::part, 0, 0}, Move{}, Falloff::linear}));
  CHECK_FALSE(falls_off_linearly({{HandleKind::section, 0, 0}, Rotate{}, Falloff::linear}));
  CHECK_FALSE(falls_off_linearly({{HandleKind::section, 0, 0}, Move{}, Falloff::gaussian}));
  CHECK(falls_off_linearly({{HandleKind::section, 0, 0}, Move{}, Falloff::linear}));
}

TEST_CASE("edits that mean nothing are refused") {
  const Handle handle;
  CHECK_NOTHROW(validate({handle, Scale{0.5, {}}}));
  CHECK_THROWS_AS(validate({handle, Scale{0, {}}}), UsageError);
  CHECK_THROWS_AS(validate({handle, Scale{-1, {}}}), UsageError);
  CHECK_THROWS_AS(validate({handle, Scale{2, Eigen::Vector3d::Zero()}}), UsageError);
  CHECK_THROWS_AS(validate({handle, Move{{0, NAN, 0}}}), UsageError);
  CHECK_THROWS_AS(validate({handle, Rotate{{0, 0, 0}, 1}}), UsageError);
  CHECK_THROWS_AS(validate({handle, Rotate{{0, 0, 1}, INFINITY}}), UsageError);
}
