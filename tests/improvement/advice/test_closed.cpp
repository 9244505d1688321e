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

TEST_CASE("A straight cup is not closed, whatever stands out at its side", "[closed]") {
  // A wall of a tenth of the radius, which a taper within a fifth at either end passes.
  const Shape cup = solids::frustum_shell({3, 3, 2.7, 2.7});
  CHECK_FALSE(pair_of(cup, 0.2));
  const Shape handle = solids::box({3, -0.3, 2}, {5.4, 0.3, 6});
  CHECK_FALSE(pair_of(concatenate(cup, handle), 0.2));
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
