#include <algorithm>
#include <cmath>
#include <vector>

#include "envelope/separation/separation_over_cone.h"
#include "stackabilization/envelope/separation.h"
#include "support/catch.h"
#include "support/point_sets.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;
using detail::SeparationOverCone;

namespace {

constexpr std::int64_t all_pairs = 10'000'000;

/// Four directions around `middle`, of any length.
std::vector<Direction> cone_around(const Eigen::Vector3d& middle, double size, point_sets::Random& random) {
  const Frame frame = frame_of(Direction(middle));
  std::vector<Direction> edges;
  for (const double x : {-size, size})
    for (const double y : {-size, size})
      edges.emplace_back(frame.to_world({x, y, 1}) * std::exp(random.uniform(-1, 1)));
  return edges;
}

Direction inside(const std::vector<Direction>& edges, point_sets::Random& random) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weights = 0;
  for (const Direction& edge : edges) {
    const double weight = random.uniform(0, 1);
    sum += weight * edge.vector();
    weights += weight;
  }
  return Direction(sum / weights);
}

/// The largest bound that is found, to a thousandth.
double best_bound(SeparationOverCone& separation, double most) {
  double shown = 0;
  for (double low = 0, high = most; high - low > 1e-3 * most;) {
    const double demand = low + (high - low) / 2;
    if (const auto bound = separation.at_least(demand, all_pairs)) {
      CHECK(*bound >= demand);
      shown = low = std::max(demand, *bound);
      high = std::max(high, low);
    } else {
      high = demand;
    }
  }
  return shown;
}

}  // namespace

TEST_CASE("no direction of a cone has a separation below the bound of the cone") {
  point_sets::Random random(17);
  const std::vector<Shape> shapes = {
      solids::box({1, 2, 3}), solids::frustum_shell({.segments = 24}), solids::boxes_sharing_wall(),
      solids::triangle_soup({.seed = 8, .count = 30}), solids::triangle_soup({.seed = 9, .count = 12})};
  int shown = 0;
  for (const Shape& shape : shapes) {
    const SeparationTree tree(shape);
    for (const ContactSemantics semantics : {ContactSemantics::solid, ContactSemantics::closed})
      for (int k = 0; k < 12; ++k) {
        const auto edges = cone_around(random.unit(), k % 3 == 0 ? 0.3 : k % 3 == 1 ? 0.05 : 0.002, random);
        SeparationOverCone over(tree, edges, semantics);
        const double most = separation(tree, tree, inside(edges, random), {semantics, {}}).value.to_double();
        if (!(most > 0)) continue;
        const double bound = best_bound(over, 4 * most);
        shown += bound > 0 ? 1 : 0;
        for (int trial = 0; trial < 20; ++trial) {
          const Separation exact = separation(tree, tree, inside(edges, random), {semantics, {}});
          REQUIRE((bound == 0 || exact.blocked));
          CHECK(exact.value >= Rational(bound));
        }
        for (const Direction& edge : edges)
          CHECK((bound == 0 || separation(tree, tree, edge, {semantics, {}}).value >= Rational(bound)));
      }
  }
  CHECK(shown > 60);  // a bound that is never found proves nothing
}

TEST_CASE("the bound of a cone within which one pair of faces touches is the least one along its edges") {
  const SeparationTree tree(solids::box({2, 2, 3}));
  // Up to a slope of 2 / 3 the top meets the bottom: sep is 3 / z.
  std::vector<Direction> edges;
  for (const double x : {-0.1, 0.1})
    for (const double y : {-0.1, 0.2}) edges.emplace_back(x, y, x > 0 && y > 0 ? 1.25 : 1.0);
  SeparationOverCone over(tree, edges, ContactSemantics::solid);
  const auto bound = over.at_least(2.3, all_pairs);
  REQUIRE(bound);
  CHECK(*bound == Approx(3 / 1.25).epsilon(1e-14));
  CHECK(*bound <= 3 / 1.25);
  CHECK(!over.at_least(2.41, all_pairs));
}

TEST_CASE("along the one direction that a wall slides along, no bound is shown for copies that do not meet") {
  // Along z the solids pass each other beyond 1; beside it the walls block, up to 3.
  const SeparationTree tree(solids::boxes_sharing_wall());
  const std::vector<Direction> around = {Direction(-1e-3, -1e-3, 1), Direction(1e-3, -1e-3, 1),
                                         Direction(-1e-3, 1e-3, 1), Direction(1e-3, 1e-3, 1)};
  SeparationOverCone solid(tree, around, ContactSemantics::solid);
  CHECK(!solid.at_least(1.1, all_pairs));
  CHECK(solid.at_least(0.99, all_pairs));
  SeparationOverCone closed(tree, {Direction(0, 0, 1)}, ContactSemantics::closed);
  CHECK(!closed.at_least(3.1, all_pairs));
}

TEST_CASE("a triangle that is seen edge on within a cone shows nothing in solid semantics") {
  // An upright triangle above a level one: beside z the upright one lands on its copy's level one, along z it
  // has no columns.
  Points vertices(6, 3);
  vertices << 0, -1, 3, 0, 1, 3, 0, 0, 2, -3, -3, 0, 3, -3, 0, 0, 4, 0;
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 3, 4, 5;
  const SeparationTree tree(make_shape(vertices, triangles));
  const auto around = [](double x) {
    return std::vector<Direction>{Direction(x - 0.01, -0.01, 1), Direction(x + 0.01, -0.01, 1),
                                  Direction(x - 0.01, 0.01, 1), Direction(x + 0.01, 0.01, 1)};
  };
  CHECK(separation(tree, tree, Direction(0, 0, 1)).length == 0);
  CHECK(!SeparationOverCone(tree, around(0), ContactSemantics::solid).at_least(1, all_pairs));
  CHECK(separation(tree, tree, Direction(0.02, 0, 1)).value.to_double() > 2.9);
  CHECK(SeparationOverCone(tree, around(0.02), ContactSemantics::solid).at_least(2.9, all_pairs));
}

TEST_CASE("the bound of a cone of one direction is not above the exact separation by a rounding") {
  // Level faces are apart by a difference of two doubles, over the length of r: nothing else is rounded. A
  // step of the last bit is worth least just below a power of two, so one of the two roundings is largest
  // where the allowance for the other one is smallest.
  solids::Random random(31);
  int tight = 0;
  for (int k = 0; k < 6000; ++k) {
    const bool long_ones = k % 2 == 0;
    const double low = -random.uniform(0, 0.05),
                 high = long_ones ? random.uniform(1.9, 1.94) : random.uniform(1, 1.05);
    const double length = (high - low) / (long_ones ? random.uniform(1, 1.05) : random.uniform(1.9, 1.99));
    const SeparationTree tree(solids::box({0, 0, low}, {1, 1, high}));
    SeparationOverCone over(tree, {Direction(0, 0, length)}, ContactSemantics::solid);
    const Rational exact = (Rational(high) - Rational(low)) / Rational(length);
    const auto bound = over.at_least(exact.to_double() * (1 - 1e-15), all_pairs);
    REQUIRE((!bound || Rational(*bound) <= exact));
    tight += bound ? 1 : 0;
  }
  CHECK(tight > 3000);
}

TEST_CASE("no pairs examined show nothing") {
  const SeparationTree tree(solids::box({1, 1, 1}));
  SeparationOverCone over(tree, {Direction(0, 0, 1)}, ContactSemantics::solid);
  CHECK(!over.at_least(0.5, 0));
  CHECK(over.at_least(0.5, all_pairs));
}
