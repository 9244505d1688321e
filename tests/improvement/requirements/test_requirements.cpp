#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "stackabilization/core/errors.h"
#include "stackabilization/improvement/requirements.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/still_designs.h"
#include "support/structures.h"

using namespace stackabilization;
using namespace stackabilization::designs;

TEST_CASE("A cup is measured as its closed form, in both box models", "[requirements]") {
  const Still space(cup());
  for (const BoxModel boxes : {BoxModel::frame, BoxModel::oriented}) {
    Requirements requirements = frame_requirements();
    requirements.measure.boxes = boxes;
    const RequirementChecker checker(space, requirements);
    const Stackability measured = checker.measure(space.rest().shape, upwards);
    CHECK(measured.f_max == Approx(4));
    CHECK(measured.value == Approx(0.5));
    CHECK(measured.extent == Approx(8));
    CHECK(checker.measure_if_above(space.rest().shape, upwards, 0.499)->value == measured.value);
    CHECK_FALSE(checker.measure_if_above(space.rest().shape, upwards, 0.501));
    CHECK(checker.measure_if_above(space.rest().shape, upwards, measured.value)->value == measured.value);
    const Assessment assessment = checker.check(space.at_rest(), upwards);
    CHECK(assessment.measured.value == Approx(measured.value).margin(1e-12));
    CHECK(assessment.separation.length == Approx(4));
    CHECK(assessment.passed());
  }
}

TEST_CASE("One measurement is that of a solver, along any direction", "[requirements]") {
  const Shape shape = transformed(
      structures::table().shape,
      Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix(), {5, -3, 1});
  for (const BoxModel boxes : {BoxModel::frame, BoxModel::oriented})
    for (const Direction& r : {upwards, Direction(0.3, -0.2, 1), Direction(-2, 0.1, 0.4)}) {
      StackabilityOptions options;
      options.boxes = boxes;
      const Stackability solved = StackabilitySolver(shape, options).measure(r);
      const Stackability once = stackability(shape, r, options);
      CHECK(once.value == Approx(solved.value).margin(1e-12));
      CHECK(once.box_volume == Approx(solved.box_volume).epsilon(1e-12));
      CHECK(once.stack_box_volume() == Approx(solved.stack_box_volume()).epsilon(1e-12));
      CHECK(once.extent == Approx(solved.extent).epsilon(1e-12));
      CHECK(stackability_if_above(shape, r, once.value, options));
      CHECK_FALSE(stackability_if_above(shape, r, once.value + 1e-9, options));
      CHECK(1 - once.value_at(2 * once.f_max) == Approx(2 * (1 - once.value)));
    }
}

TEST_CASE("Air between copies lowers S by what it takes", "[requirements]") {
  const Still space(cup());
  const Shape& shape = space.rest().shape;
  Requirements requirements = frame_requirements();
  requirements.measure.clearance = 0.4;
  {
    const RequirementChecker checker(space, requirements);
    CHECK(checker.measure(shape, upwards).f_max == Approx(4.4));
    CHECK(checker.measure(shape, upwards).value == Approx(1 - 4.4 / 8));
    CHECK(checker.check(space.at_rest(), upwards).measured.value == Approx(1 - 4.4 / 8));
    CHECK(checker.check(space.at_rest(), upwards).separation.length == Approx(4));
    CHECK_FALSE(checker.measure_if_above(shape, upwards, 0.46));
    CHECK(checker.measure_if_above(shape, upwards, 0.44)->value == Approx(0.45));
  }
  // Sideways by p, walls of slope 1/8 meet 8 p higher; the polygon around the disc and the facets of the cup
  // add a little.
  requirements.measure.clearance = 0.1;
  requirements.measure.play = 0.05;
  const double most = 0.4 / std::cos(std::numbers::pi / 16) / std::cos(std::numbers::pi / 64);
  const RequirementChecker checker(space, requirements);
  for (const Stackability& measured :
       {checker.measure(shape, upwards), checker.check(space.at_rest(), upwards).measured}) {
    CHECK(measured.f_max >= 4 + 0.1 + 0.4 - 1e-9);
    CHECK(measured.f_max <= 4 + 0.1 + most + 1e-9);
    CHECK(measured.value == Approx(1 - measured.f_max / 8));
  }
}

TEST_CASE("What requirements forbid a deformation", "[requirements]") {
  const StructuredShape table = structures::table();
  Requirements requirements;
  requirements.kept_parts = {3, 0};
  requirements.editable_parts = {0, 1, 2, 3, 4, 5, 7};
  requirements.box_tolerance = 0.2;
  const DeformationConstraints constraints = deformation_constraints(requirements, table, {1, 0, 2});
  CHECK(constraints.keep_extent->vector() == Eigen::Vector3d(1, 0, 2));
  CHECK(constraints.box_tolerance == 0.2);
  CHECK(constraints.fixed_parts == std::vector<int>{0, 3, 6, 8});
  requirements.kept_parts = {};
  requirements.editable_parts = {1};  // and the other legs with it
  CHECK(deformation_constraints(requirements, table, upwards).fixed_parts == std::vector<int>{0, 5, 6, 7, 8});
  requirements = {};
  requirements.keep_height = false;
  const DeformationConstraints none = deformation_constraints(requirements, table, upwards);
  CHECK_FALSE(none.keep_extent);
  CHECK_FALSE(none.box_tolerance);
  CHECK(none.fixed_parts.empty());
}

TEST_CASE("Requirements that make no sense are refused", "[requirements]") {
  const Still space(two_cubes());
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const auto refused = [&](auto change) {
    Requirements requirements;
    change(requirements);
    CHECK_THROWS_AS(RequirementChecker(space, requirements), UsageError);
  };
  for (const double target : {1.0, 2.0, nan, -infinity}) refused([&](Requirements& r) { r.target = target; });
  for (const int part : {-1, 2}) {
    refused([&](Requirements& r) { r.kept_parts = {part}; });
    refused([&](Requirements& r) { r.editable_parts = {0, part}; });
    refused([&](Requirements& r) { r.resting_part = part; });
  }
  for (const double bad : {-0.1, nan, infinity}) {
    refused([&](Requirements& r) { r.measure.clearance = bad; });
    refused([&](Requirements& r) { r.measure.play = bad; });
    refused([&](Requirements& r) { r.box_tolerance = bad; });
    refused([&](Requirements& r) { r.min_thickness = bad; });
    refused([&](Requirements& r) { r.min_draft_degrees = bad; });
    refused([&](Requirements& r) { r.friction = bad; });
    refused([&](Requirements& r) {
      r.standing_copies = 2;
      r.min_tipping_degrees = bad;
    });
  }
  for (const double bad : {-0.1, 1.1, nan}) refused([&](Requirements& r) { r.min_size_ratio = bad; });
  for (const double bad : {0.0, 1.0, nan}) refused([&](Requirements& r) { r.min_air_elsewhere = bad; });
  refused([](Requirements& r) { r.measure.clearance = 1e8; });
  refused([](Requirements& r) { r.measure.play = 1e8; });
  for (const double bad : {0.0, -1.0, nan, infinity})
    refused([&](Requirements& r) { r.length_limit = StackLengthLimit{2, bad}; });
  refused([](Requirements& r) { r.length_limit = StackLengthLimit{1, 10}; });
  refused([](Requirements& r) { r.min_draft_degrees = 90.5; });
  refused([](Requirements& r) { r.standing_copies = 0; });
  refused([](Requirements& r) { r.min_tipping_degrees = 5; });
  refused([](Requirements& r) { r.measure.flat_shapes = FlatShapes::measure; });
  CHECK_NOTHROW(RequirementChecker(space, Requirements()));
}

TEST_CASE("Designs of something else, and flat ones, are refused", "[requirements]") {
  const Still space(two_cubes());
  const RequirementChecker checker(space, frame_requirements());
  Design fewer = space.at_rest();
  fewer.primitives.pop_back();
  CHECK_THROWS_AS(checker.check(fewer, upwards), UsageError);
  CHECK_THROWS_AS(checker.check(Still(cup()).at_rest(), upwards), UsageError);
  const Design flat = scaled(space.at_rest(), {1, 1, 0});
  CHECK_THROWS_AS(checker.check(flat, upwards), InputError);
  CHECK_THROWS_AS(checker.measure(flat.shape, upwards), InputError);
}
