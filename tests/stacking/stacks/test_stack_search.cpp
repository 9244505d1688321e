#include <tbb/task_arena.h>

#include <numbers>

#include "stackabilization/core/errors.h"
#include "stackabilization/stacking/stack_search.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

PeriodOptions period(int length, int copies) {
  PeriodOptions options;
  options.period = length;
  options.stack.copies = copies;
  return options;
}

TwistOptions twist(int copies, TwistGoal goal) {
  TwistOptions options;
  options.stack.copies = copies;
  options.goal = goal;
  options.step_degrees = 15;
  return options;
}

}  // namespace

TEST_CASE("alternately flipped wedges fill their box") {
  const Shape wedge = solids::extruded_profile({{0, 0}, {2, 0}, {0, 2}}, 1);
  const PeriodResult best = best_period_stack(wedge, upwards, period(2, 2));
  CHECK(best.stack.copies[1].offset_length == Approx(0).margin(1e-12));
  CHECK(best.stack.height == Approx(2));
  CHECK(best.stack.increment == Approx(1));
  CHECK(best.stack.stackability == Approx(0.5));
  CHECK(best.poses[0] == "upright");
  CHECK(best.poses[1].starts_with("flipped"));
}

TEST_CASE("alternately flipped L-shapes pack without a gap") {
  const PeriodResult best = best_period_stack(solids::l_shape(2, 1), upwards, period(2, 6));
  CHECK(best.stack.height == Approx(9));
  CHECK(best.stack.increment == Approx(1.5));
  CHECK(best.stack.stack_volume == Approx(18));
  CHECK(best.stack.stackability == Approx(0.25));
}

TEST_CASE("a longer period is never worse than the straight stack") {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Shape shape = solids::triangle_soup({.seed = seed, .count = 10, .size = 0.8});
    const double straight = best_period_stack(shape, upwards, period(1, 6)).stack.stackability;
    const PeriodResult two = best_period_stack(shape, upwards, period(2, 6)),
                       three = best_period_stack(shape, upwards, period(3, 6));
    CHECK(two.stack.stackability >= straight);
    CHECK(three.stack.stackability >= straight);
    CHECK(two.poses.size() == 2);
    CHECK(three.poses.size() == 3);
  }
}

TEST_CASE("a cup is not flipped or turned for nothing") {
  const Shape cup = solids::frustum_shell({.segments = 16});
  CHECK(best_period_stack(cup, upwards, period(2, 5)).poses ==
        std::vector<std::string>{"upright", "upright"});
  CHECK(best_twist(cup, upwards, twist(5, TwistGoal::stackability)).twist_degrees == 0);
}

TEST_CASE("a square bin stays untwisted") {
  const Shape bin = solids::frustum_shell({.outer_bottom = 2, .inner_bottom = 1.5, .segments = 4});
  for (const TwistGoal goal : {TwistGoal::stackability, TwistGoal::height}) {
    const TwistResult best = best_twist(bin, upwards, twist(4, goal));
    CHECK(best.twist_degrees == 0);
    CHECK(best.stack.height == best.untwisted_height);
  }
}

TEST_CASE("a post beside a column twists out of its own way") {
  const Shape stair =
      concatenate(solids::box({-0.5, -0.5, 0}, {0.5, 0.5, 1}), solids::box({1.5, -0.5, 0}, {2.5, 0.5, 3.5}));
  TwistOptions options = twist(4, TwistGoal::height);
  options.stack.axis_point = Eigen::Vector3d::Zero();
  const TwistResult best = best_twist(stair, upwards, options);
  CHECK(best.untwisted_height == 14);
  CHECK(best.stack.height == Approx(6.5));
  // It pays for the height with its footprint.
  options.goal = TwistGoal::stackability;
  CHECK(best.stack.stackability < best_twist(stair, upwards, options).stack.stackability);
}

TEST_CASE("refinement finds a twist between the samples") {
  // A square bin whose inner walls are turned by -7 degrees against the outer ones nests best at that twist,
  // one by one.
  const double corner = std::numbers::sqrt2;
  Shape bin = solids::frustum_shell({corner, 4 * corner, 0.75 * corner, 3.5 * corner, 6, 0.5, 4});
  const RigidTransform turn = rotation_about({Eigen::Vector3d::Zero(), upwards}, -7);
  for (Eigen::Index v = 0; v < bin.vertex_count(); ++v) {
    const Eigen::Vector3d p = bin.vertices.row(v).transpose();
    const bool inner = p.z() == 0.5 || (p.z() == 6 && p.head<2>().norm() < 3.75 * corner);
    if (inner) bin.vertices.row(v) = (turn.rotation * p).transpose();
  }
  const TwistResult best = best_twist(bin, upwards, twist(3, TwistGoal::height));
  CHECK(best.twist_degrees == Approx(-7).margin(0.02));
  CHECK(best.stack.height == Approx(8).margin(0.01));
  CHECK(best.untwisted_height > 9);
}

TEST_CASE("one and two threads find the same") {
  const Shape shape = solids::triangle_soup({.seed = 9, .count = 12, .size = 0.6});
  const auto run = [&](int threads) {
    std::pair<TwistResult, PeriodResult> results;
    tbb::task_arena arena(threads);
    arena.execute([&] {
      results = {best_twist(shape, upwards, twist(4, TwistGoal::stackability)),
                 best_period_stack(shape, upwards, period(3, 5))};
    });
    return results;
  };
  const auto one = run(1), two = run(2);
  CHECK(one.first.twist_degrees == two.first.twist_degrees);
  CHECK(one.first.stack.stackability == two.first.stack.stackability);
  CHECK(one.second.poses == two.second.poses);
  for (std::size_t k = 0; k < 5; ++k)
    CHECK(one.second.stack.copies[k].offset == two.second.stack.copies[k].offset);
}

TEST_CASE("searches refuse what they cannot search") {
  const Shape cube = solids::box({1, 1, 1});
  CHECK_THROWS_AS(best_period_stack(cube, upwards, period(0, 2)), UsageError);
  CHECK_THROWS_AS(best_period_stack(cube, upwards, period(6, 2)), UsageError);
  PeriodOptions given = period(2, 2);
  given.stack.poses.resize(2);
  CHECK_THROWS_AS(best_period_stack(cube, upwards, given), UsageError);
  TwistOptions options = twist(2, TwistGoal::height);
  options.step_degrees = 0;
  CHECK_THROWS_AS(best_twist(cube, upwards, options), UsageError);
  options = twist(2, TwistGoal::height);
  options.finest_degrees = 0;
  CHECK_THROWS_AS(best_twist(cube, upwards, options), UsageError);
}
