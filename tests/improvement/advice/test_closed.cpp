#include "stackabilization/improvement/closed.h"
#include "stackabilization/stacking/stackability.h"
#include "support/catch.h"
#include "support/messages.h"
#include "support/solids.h"
#include "support/structures.h"

namespace stackabilization {
namespace {

std::optional<ClosedPair> pair_of(const Shape& shape, double target,
                                  const Direction& r = Direction(0, 0, 1)) {
  return closed_pair(shape, r, stackability(shape, r), target);
}

}  // namespace

TEST_CASE("A box is closed along every axis", "[closed]") {
  const Shape box = solids::box({2, 3, 4});
  for (const Eigen::Vector3d& r :
       {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 2, 0), Eigen::Vector3d(-1, 0, 0)}) {
    const auto pair = pair_of(box, 0.2, Direction(r));
    REQUIRE(pair);
    CHECK(pair->upper_part == 0);
    CHECK(pair->lower_part == 0);
    CHECK(pair->stackability >= 0);
    CHECK(pair->stackability < 0.02);
  }
}

TEST_CASE("Nothing is closed to a target that holds at rest", "[closed]") {
  CHECK_FALSE(pair_of(solids::box({2, 3, 4}), 0));
  CHECK_FALSE(pair_of(solids::box({2, 3, 4}), -0.5));
}

TEST_CASE("Tables, cups and boxes without a lid are not closed", "[closed]") {
  CHECK_FALSE(pair_of(structures::table().shape, 0.2));
  CHECK_FALSE(pair_of(structures::table().shape, 0.9));
  CHECK_FALSE(pair_of(solids::frustum_shell({}), 0.9));
}

TEST_CASE("A straight cup is closed by a wall that no taper passes, whatever stands out at its side",
          "[closed]") {
  const auto is_closed = [](double inner, double handle) {
    const Shape cup = solids::frustum_shell({3, 3, inner, inner}),
                with_handle = concatenate(cup, solids::box({3, -0.3, 2}, {3 + handle, 0.3, 6}));
    return pair_of(handle > 0 ? with_handle : cup, 0.2).has_value();
  };
  // The rim may get wider by 1 / 0.8, and the foot narrower by 0.8: the bore must exceed 3 x 0.64.
  for (const double handle : {0.0, 2.0, 7.0}) {
    CHECK_FALSE(is_closed(2.7, handle));
    CHECK_FALSE(is_closed(2.1, handle));
    CHECK(is_closed(1.7, handle));
  }
}

TEST_CASE("A table on one wide foot is closed, on a narrow one at its rim it is not", "[closed]") {
  Shape pedestal = concatenate(solids::box({-5, -5, 7}, {5, 5, 8}), solids::box({-3, -3, 0}, {3, 3, 1}));
  pedestal = concatenate(pedestal, solids::box({-1, -1, 1}, {1, 1, 7}));
  const auto pair = pair_of(pedestal, 0.2);
  REQUIRE(pair);
  CHECK(pair->upper_part != pair->lower_part);
  const Shape shelf = concatenate(solids::box({-5, -5, 7}, {5, 5, 8}), solids::box({4, -5, 0}, {5, 5, 7}));
  CHECK_FALSE(pair_of(shelf, 0.2));
}

}  // namespace stackabilization
