#include <cmath>
#include <numbers>

#include "stackabilization/deformation/edit.h"
#include "stackabilization/shape/errors.h"
#include "support/catch.h"

using namespace stackabilization;

TEST_CASE("edits are described by part, operation and amount") {
  const std::vector<std::string> names = {"seat", "leg"};
  CHECK(describe({{HandleKind::face, 1, 3}, Move{{0.125, 0, -2}}}, names) ==
        "move face 3 of leg by (0.125, 0, -2)");
  CHECK(describe({{HandleKind::part, 0, 0}, Rotate{{0, 0, 1}, std::numbers::pi / 4}}, names) ==
        "rotate seat by 45 degrees about (0, 0, 1)");
  CHECK(describe({{HandleKind::section, 1, 7}, Scale{0.9, {}}}, names) ==
        "scale cross-section 7 of leg by 0.9");
  CHECK(describe({{HandleKind::shape, 0, 0}, Scale{2, Eigen::Vector3d(1, 0, 0)}}, names) ==
        "scale the shape by 2 along (1, 0, 0)");
  CHECK(describe({{HandleKind::section, 1, 7}, Scale{0.9, {}}, Falloff::linear}, names) ==
        "scale cross-section 7 of leg by 0.9, linearly");
  CHECK(describe({{HandleKind::section, 0, 0}, Move{{1, 0, 0}}, Falloff::linear}, names) ==
        "move cross-section 0 of seat by (1, 0, 0), linearly");
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
