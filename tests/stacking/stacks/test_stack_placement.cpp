#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "stacking/stacks/stack_placement.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

namespace stackabilization::stack_placement_test {

namespace {

const Direction upwards(0, 0, 1);

struct Stack {
  StackPairs pairs;
  std::vector<int> sequence;

  int pose(int copy) const { return sequence[static_cast<std::size_t>(copy) % sequence.size()]; }
};

/// Random triangles, repeated in so many random poses.
Stack soup(std::uint64_t seed, int poses, double twist_degrees = 0) {
  StackOptions options;
  options.twist_degrees = twist_degrees;
  if (twist_degrees != 0) options.axis_point = Eigen::Vector3d::Zero();
  for (int k = 0; k < poses; ++k)
    options.poses.push_back(
        {solids::random_rotation(31 * seed + static_cast<std::uint64_t>(k)), Eigen::Vector3d::Zero()});
  StackPairs pairs(solids::triangle_soup({.seed = seed, .count = 6, .size = 0.8}), upwards, options);
  std::vector<int> sequence = pairs.sequence();
  return {std::move(pairs), std::move(sequence)};
}

/// The highest demand of copies `from` to k - 1, standing at `lifts`, on copy k; the nearest of several.
std::pair<Rational, int> highest_demand(Stack& stack, const std::vector<Rational>& lifts, int from, int k) {
  Rational lift = stack.pairs.span(stack.pose(0)).bottom - stack.pairs.span(stack.pose(k)).bottom;
  int rests_on = -1;
  for (int j = k - 1; j >= from; --j) {
    const Demand& demand = stack.pairs.demand(stack.pose(j), stack.pose(k), k - j);
    if (!demand.blocked) continue;
    const Rational wanted = lifts[static_cast<std::size_t>(j)] + demand.lift;
    if (wanted > lift || (wanted == lift && rests_on < 0)) {
      lift = wanted;
      rests_on = j;
    }
  }
  return {lift, rests_on};
}

/// Largest mean lift per copy over all closed chains of contacts of an endlessly repeated sequence, by a walk
/// over all simple cycles.
double largest_cycle_mean(Stack& stack) {
  const int period = static_cast<int>(stack.sequence.size());
  double largest = 0;
  std::vector<bool> on_way(static_cast<std::size_t>(period), false);
  int first = 0;
  const std::function<void(int, double, int)> walk = [&](int at, double lift, int copies) {
    for (int next = first; next < period; ++next) {
      const int lag = next > at ? next - at : next - at + period;
      const Demand& demand = stack.pairs.demand(stack.pose(at), stack.pose(next), lag);
      if (!demand.blocked) continue;
      if (next == first) largest = std::max(largest, (lift + demand.approximate) / (copies + lag));
      if (on_way[static_cast<std::size_t>(next)]) continue;
      on_way[static_cast<std::size_t>(next)] = true;
      walk(next, lift + demand.approximate, copies + lag);
      on_way[static_cast<std::size_t>(next)] = false;
    }
  };
  for (first = 0; first < period; ++first) {
    on_way.assign(static_cast<std::size_t>(period), false);
    on_way[static_cast<std::size_t>(first)] = true;
    walk(first, 0, 0);
  }
  return largest;
}

}  // namespace

TEST_CASE("copies stand where the highest of all demands on them says, exactly") {
  for (std::uint64_t seed = 1; seed <= 8; ++seed)
    for (const double twist : {0.0, 37.0}) {
      Stack stack = soup(seed, 1 + static_cast<int>(seed) % 4, twist);
      constexpr int copies = 12;
      for (const Reach reach : {Reach::all, Reach::neighbour}) {
        const Placement placed = place(stack.pairs, stack.sequence, copies, reach);
        REQUIRE(placed.lifts.size() == copies);
        double top = -std::numeric_limits<double>::infinity();
        for (int k = 0; k < copies; ++k) {
          const auto row = static_cast<std::size_t>(k);
          const auto [lift, rests_on] =
              highest_demand(stack, placed.lifts, reach == Reach::all ? 0 : std::max(0, k - 1), k);
          CHECK(placed.lifts[row] == lift);
          CHECK(placed.rests_on[row] == rests_on);
          CHECK(placed.approximate[row] == lift.to_double());
          top = std::max(top, placed.approximate[row] + stack.pairs.span(stack.pose(k)).approximate_top);
        }
        CHECK(placed_height(stack.pairs, stack.sequence, placed) ==
              Approx(top - stack.pairs.span(stack.pose(0)).approximate_bottom).epsilon(1e-14));
      }
    }
}

TEST_CASE("a copy that reaches the floor and another copy at once rests on the copy") {
  // Two cubes as a stair; moved back by one, the high cube of the next comes down just onto the low one.
  const Shape stair = concatenate(solids::box({0, 0, 0}, {1, 1, 1}), solids::box({1, 0, 1}, {2, 1, 2}));
  StackOptions options;
  options.poses = {{Eigen::Matrix3d::Identity(), {0, 0, 0}}, {Eigen::Matrix3d::Identity(), {-1, 0, 0}}};
  StackPairs pairs(stair, upwards, options);
  const Placement placed = place(pairs, pairs.sequence(), 2, Reach::all);
  CHECK(placed.approximate[1] == 0);
  CHECK(placed.rests_on == std::vector<int>{-1, 0});
}

TEST_CASE("a copy is stopped by the highest of those below, however low the ones between are") {
  // Bars of 10 x 1 x 2: upright at 0, flat and far away, on its side across x = 4, and one over both.
  Eigen::Matrix3d upright, flat, across;
  upright << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  flat << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  across << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  StackOptions options;
  options.poses = {{upright, {0, 0, 0}},
                   {flat, {100, 0, 0}},
                   {across, {4, 0, 0}},
                   {Eigen::Matrix3d::Identity(), {2, 0, 0}}};
  StackPairs pairs(solids::box({-5, -0.5, -1}, {5, 0.5, 1}), upwards, options);
  const Placement placed = place(pairs, pairs.sequence(), 4, Reach::all);
  // Middles of the bars, over a floor at -5.
  CHECK(placed.approximate == std::vector<double>{0, -4.5, -4, 6});
  CHECK(placed.rests_on == std::vector<int>{-1, -1, -1, 0});
  CHECK(placed_height(pairs, pairs.sequence(), placed) == 12);
  // Looking at neighbours alone it would stand 8 deep in the upright one.
  const Placement neighbours = place(pairs, pairs.sequence(), 4, Reach::neighbour);
  const std::vector<StackConflict> conflicts = find_conflicts(pairs, pairs.sequence(), neighbours);
  REQUIRE(conflicts.size() == 1);
  CHECK(conflicts[0].below == 0);
  CHECK(conflicts[0].above == 3);
  CHECK(conflicts[0].overlap == 8);
}

TEST_CASE("conflicts are how deep a copy that rests on its neighbour stands in the ones below") {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Stack stack = soup(seed, 3);
    const Placement neighbours = place(stack.pairs, stack.sequence, 12, Reach::neighbour);
    const std::vector<StackConflict> conflicts = find_conflicts(stack.pairs, stack.sequence, neighbours);
    std::size_t next = 0;
    for (int k = 2; k < 12; ++k) {
      // Without its neighbour, the highest demand of the others.
      const Rational& stands = neighbours.lifts[static_cast<std::size_t>(k)];
      double overlap = 0;
      int below = -1;
      for (int j = k - 2; j >= 0; --j) {
        const Demand& demand = stack.pairs.demand(stack.pose(j), stack.pose(k), k - j);
        if (!demand.blocked) continue;
        const double depth =
            (neighbours.lifts[static_cast<std::size_t>(j)] + demand.lift - stands).to_double();
        if (depth > overlap) {
          overlap = depth;
          below = j;
        }
      }
      if (overlap < 1e-6) continue;
      REQUIRE(next < conflicts.size());
      CHECK(conflicts[next].above == k);
      CHECK(conflicts[next].below == below);
      CHECK(conflicts[next].overlap == Approx(overlap).epsilon(1e-12));
      ++next;
      ++found;
    }
    CHECK(next == conflicts.size());
  }
  CHECK(found > 10);
}

TEST_CASE("the long-run increment is the largest mean over the closed chains of contacts") {
  for (std::uint64_t seed = 1; seed <= 8; ++seed)
    for (const int poses : {1, 2, 3, 4}) {
      Stack stack = soup(seed, poses);
      const Placement placed = place(stack.pairs, stack.sequence, 6, Reach::all);
      CHECK(long_run_increment(stack.pairs, stack.sequence, placed) ==
            Approx(largest_cycle_mean(stack)).epsilon(1e-9));
    }
}

TEST_CASE("the hull of a stack is that of its lowest and its highest copy of every pose") {
  Stack stack = soup(4, 3);
  const Placement placed = place(stack.pairs, stack.sequence, 11, Reach::all);
  const Shape shape = solids::triangle_soup({.seed = 4, .count = 6, .size = 0.8});
  const HullSupport few(stack_hull_points(stack.pairs, stack.sequence, placed, HullSupport(shape)));
  Points all(11 * shape.vertex_count(), 3);
  for (int k = 0; k < 11; ++k)
    all.middleRows(k * shape.vertex_count(), shape.vertex_count()) =
        transformed(shape, stack.pairs.transform(stack.pose(k), k)).vertices.rowwise() +
        Eigen::RowVector3d(0, 0, placed.approximate[static_cast<std::size_t>(k)]);
  const HullSupport every(all);
  solids::Random random(3);
  for (int trial = 0; trial < 50; ++trial) {
    const Direction r(random.on_sphere());
    CHECK(few.extent(r) == Approx(every.extent(r)).epsilon(1e-12));
  }
}

}  // namespace stackabilization::stack_placement_test
