#include <limits>

#include "stackabilization/core/errors.h"
#include "stackabilization/stacking/plan.h"
#include "support/catch.h"

using namespace stackabilization;

namespace {

/// A chair of 0.8 m that stacks every 0.2 m; its box along r is the box itself.
Stackability chair() {
  return {{0, 0, 1}, 0.2, 0.8, 0.4, 0.5, 0.75};
}

}  // namespace

TEST_CASE("ten chairs within two metres") {
  const StackPlan plan = plan_stack(chair(), {10, 2, 0});
  CHECK(plan.possible);
  CHECK(*plan.translation == Approx(1.2 / 9));
  CHECK(*plan.f_max == Approx(1.2 / 9));
  CHECK(*plan.stackability == Approx(1 - 1.2 / 9 / 0.8));
  CHECK_FALSE(plan.met);
  CHECK(plan.length_now == Approx(2.6));
  CHECK(*plan.copies_now == 7);
}

TEST_CASE("the stackability of a plan counts air as part of every copy") {
  const StackPlan plan = plan_stack(chair(), {10, 2, 0.01});
  CHECK(*plan.f_max == Approx(1.2 / 9 - 0.01));
  CHECK(*plan.stackability == *plan_stack(chair(), {10, 2, 0}).stackability);
  CHECK(*plan.stackability == stackability_within(chair(), 10, 2));
  // Boxes count as in Eq. 3.
  const Stackability leaning{{0, 0, 1}, 0.2, 0.8, 0.4, 0.75, 0.625};
  CHECK(stackability_within(leaning, 10, 2) == Approx(1 - 1.2 / 9 / 0.8 * 1.5));
}

TEST_CASE("what a plan demands is just enough") {
  Stackability better = chair();
  const StackRequest wish{10, 2, 0.01};
  better.f_max = *plan_stack(chair(), wish).f_max + wish.clearance;
  const StackPlan plan = plan_stack(better, wish);
  CHECK(plan.met);
  CHECK(plan.length_now == Approx(2));
  CHECK(*plan.copies_now == 10);
  better.f_max *= 1.001;
  CHECK_FALSE(plan_stack(better, wish).met);
  CHECK(*plan_stack(better, wish).copies_now == 9);
}

TEST_CASE("crates of pitch 0.1 fill 1 m in spite of rounding") {
  const Stackability crate{{0, 0, 1}, 0.1, 0.3, 1, 1 / 0.3, 2. / 3};
  CHECK(plan_stack(crate, {8, 1, 0}).met);
  CHECK(*plan_stack(crate, {8, 1, 0}).copies_now == 8);
}

TEST_CASE("the borders of a plan") {
  CHECK_FALSE(plan_stack(chair(), {2, 0.5, 0}).possible);
  CHECK(*plan_stack(chair(), {2, 0.5, 0}).copies_now == 0);
  CHECK_FALSE(plan_stack(chair(), {3, 1, 0.2}).possible);
  const StackPlan one = plan_stack(chair(), {1, 0.8, 0.5});
  CHECK(one.met);
  CHECK_FALSE(one.translation.has_value());
  CHECK_FALSE(one.stackability.has_value());
  Stackability sheet = chair();
  sheet.f_max = 0;
  CHECK_FALSE(plan_stack(sheet, {5, 1, 0}).copies_now.has_value());
  CHECK(plan_stack(sheet, {1000000, 0.8, 0}).met);
}

TEST_CASE("a plan refuses what is not a wish") {
  CHECK_THROWS_AS(plan_stack(chair(), {0, 1, 0}), UsageError);
  CHECK_THROWS_AS(plan_stack(chair(), {2, 0, 0}), UsageError);
  CHECK_THROWS_AS(plan_stack(chair(), {2, std::numeric_limits<double>::infinity(), 0}), UsageError);
  CHECK_THROWS_AS(plan_stack(chair(), {2, 1, -0.1}), UsageError);
}
