#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "deformation/controllers/extent_bounds.h"
#include "stackabilization/core/errors.h"
#include "support/catch.h"
#include "support/messages.h"
#include "support/solids.h"
#include "support/structures.h"

namespace stackabilization::extent_bounds_test {

using namespace detail;

namespace {

DeformationConstraints keeping(const Direction& direction, ExtentEnds ends = ExtentEnds::free) {
  DeformationConstraints constraints;
  constraints.keep_extent = direction;
  constraints.extent_ends = ends;
  return constraints;
}

Points on_axis(const std::vector<double>& heights) {
  Points points = Points::Zero(static_cast<Eigen::Index>(heights.size()), 3);
  for (std::size_t k = 0; k < heights.size(); ++k) points(static_cast<Eigen::Index>(k), 2) = heights[k];
  return points;
}

ExtentBound bound(double low, double high, std::optional<double> level = std::nullopt) {
  return {Eigen::Vector3d::UnitZ(), low, high, level};
}

double excess(const ExtentBound& of, const std::vector<double>& heights) {
  std::vector<std::vector<int>> groups(1);
  for (std::size_t k = 0; k < heights.size(); ++k) groups[0].push_back(static_cast<int>(k));
  const ActiveExtentConstraints watch(groups, {of});
  CHECK(watch.any_excess(on_axis(heights)) == (watch.excess(0, on_axis(heights)) != 0));
  return watch.excess(0, on_axis(heights));
}

}  // namespace

TEST_CASE("bounds are the extent at rest, kept or within a tolerance") {
  const Shape box = solids::box({-1, 2, 3}, {1, 5, 7});
  CHECK(extent_bounds(box, {}).empty());

  const std::vector<ExtentBound> kept = extent_bounds(box, keeping({1, 1, 0}));
  REQUIRE(kept.size() == 1);
  CHECK(kept[0].normal.isApprox(Eigen::Vector3d(1, 1, 0).normalized(), 1e-15));
  CHECK(kept[0].low == Approx(5 / std::sqrt(2.0)).epsilon(1e-14));
  CHECK(kept[0].low == kept[0].high);
  CHECK_FALSE(kept[0].level);

  CHECK(extent_bounds(box, keeping({0, 0, 2}, ExtentEnds::fixed))[0].level == 3);

  DeformationConstraints constraints = keeping({0, 0, 1});
  constraints.box_tolerance = 0.125;
  const std::vector<ExtentBound> all = extent_bounds(box, constraints);
  REQUIRE(all.size() == 4);
  const Eigen::Vector3d sides(2, 3, 4);
  for (int axis = 0; axis < 3; ++axis) {
    const ExtentBound& side = all[static_cast<std::size_t>(1 + axis)];
    CHECK(side.normal == Eigen::Vector3d::Unit(axis));
    CHECK(side.low == Approx(0.875 * sides(axis)).epsilon(1e-15));
    CHECK(side.high == Approx(1.125 * sides(axis)).epsilon(1e-15));
    CHECK_FALSE(side.level);
  }
}

TEST_CASE("tolerances of the box that make no sense are refused") {
  for (const double tolerance :
       {-0.1, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    DeformationConstraints constraints;
    constraints.box_tolerance = tolerance;
    CHECK(message_of<UsageError>([&] {
            extent_bounds(solids::box({1, 1, 1}), constraints);
          }) == "the tolerance of the box must be 0 or positive");
  }
  DeformationConstraints constraints;
  constraints.box_tolerance = 0;
  CHECK(extent_bounds(solids::box({1, 1, 1}), constraints).size() == 3);
}

TEST_CASE("vertices belong to the parts and classes whose triangles use them, once and in order") {
  const StructuredShape table = structures::table(1);
  const Rig rig(table.structure);
  const auto by_part = vertices_by_part(table.shape), by_class = vertices_by_class(table.shape, rig);
  REQUIRE(by_part.size() == 9);
  REQUIRE(by_class.size() == 4);
  for (const auto& lists : {by_part, by_class}) {
    std::size_t sum = 0;
    for (const std::vector<int>& list : lists) {
      CHECK(std::is_sorted(list.begin(), list.end(), std::less_equal<>()));
      sum += list.size();
    }
    CHECK(sum == static_cast<std::size_t>(table.shape.vertex_count()));  // no part shares any
  }
  for (int part = 0; part < 9; ++part) {
    const Shape own = extract_part(table.shape, part);
    CHECK(by_part[static_cast<std::size_t>(part)].size() == static_cast<std::size_t>(own.vertex_count()));
  }
  CHECK(by_class[1].size() == 4 * by_part[1].size());
}

TEST_CASE("the excess is what is too long, negative where it is too short, and none within rounding") {
  CHECK(excess(bound(3, 5), {1, 2, 5}) == 0);
  CHECK(excess(bound(3, 5), {1, 2, 6.5}) == Approx(0.5).epsilon(1e-14));
  CHECK(excess(bound(3, 5), {1, 2, 3}) == Approx(-1).epsilon(1e-14));
  // Half of tolerance::relative, 1e-9, of the length.
  CHECK(excess(bound(4, 4), {0, 4 * (1 + 4e-10)}) == 0);
  CHECK(excess(bound(4, 4), {0, 4 * (1 + 6e-10)}) > 0);
  CHECK(excess(bound(4, 4), {0, 4 * (1 - 6e-10)}) < 0);
}

TEST_CASE("with fixed ends the excess is that of the end farther off, outwards positive") {
  const ExtentBound fixed = bound(4, 4, 1.0);
  CHECK(excess(fixed, {1, 5}) == 0);
  CHECK(excess(fixed, {0.5, 5.25}) == Approx(0.5).epsilon(1e-14));
  CHECK(excess(fixed, {0.75, 5.5}) == Approx(0.5).epsilon(1e-14));
  CHECK(excess(fixed, {1.5, 5.25}) == Approx(-0.5).epsilon(1e-14));
  CHECK(excess(fixed, {2, 6}) != 0);  // the length is right, the place is not
}

TEST_CASE(
    "heights are those of the grouped vertices, and what is wanted begins at the lowest or the fixed end") {
  const std::vector<std::vector<int>> groups = {{0, 1}, {3}};
  const Points points = on_axis({1, 2, 99, 4});
  const ActiveExtentConstraints free(groups, {bound(5, 5)}), fixed(groups, {bound(5, 5, 0.5)}),
      slack(groups, {bound(2, 5)});
  CHECK(free.range(0, points).low == 1);
  CHECK(free.range(0, points).high == 4);
  CHECK(free.levels(points)(0) == 1);
  CHECK(free.wanted(0, points).low == 1);
  CHECK(free.wanted(0, points).high == 6);
  CHECK(fixed.wanted(0, points).low == 0.5);
  CHECK(fixed.wanted(0, points).high == 5.5);
  CHECK(free.is_kept(0));
  CHECK_FALSE(slack.is_kept(0));
}

TEST_CASE("a violated bound holds the outermost vertex of every group that reaches into the excess") {
  const StructuredShape table = structures::table(0);
  const Rig rig(table.structure);
  const MeshTransfer transfer(table.shape, rig);
  const auto groups = vertices_by_class(table.shape, rig);
  ActiveExtentConstraints watch(groups, extent_bounds(table.shape, keeping({0, 0, 1})));
  CHECK(watch.constraints(transfer).empty());
  CHECK_FALSE(watch.any_excess(table.shape.vertices));

  // The top alone goes up by 0.25; legs, whose tops are at 5.5 of 6, do not reach into that.
  Points points = table.shape.vertices;
  for (const int v : groups[0]) points(v, 2) += 0.25;
  CHECK(watch.excess(0, points) == Approx(0.25).epsilon(1e-14));
  CHECK(watch.hold(0, points, ActiveExtentConstraints::OnExchange::keep));
  std::vector<Constraint> held = watch.constraints(transfer);
  REQUIRE(held.size() == 2);
  // In the order of sides: the lowest vertex of the legs at the level, the highest of the top 6 above.
  CHECK(held[0].height == 0);
  CHECK(held[1].height == 6);
  for (const Constraint& one : held) {
    CHECK(one.normal == Eigen::Vector3d(0, 0, 1));
    CHECK(one.level == 0);
    REQUIRE(one.bound_points.size() == 1);
    const BoundPoint& bound = one.bound_points[0];
    const Eigen::Vector3d at = rig.primitive_bindings[static_cast<std::size_t>(bound.part)].position_of(
        bound.binding, rig.primitive_bindings[static_cast<std::size_t>(bound.part)].rest());
    CHECK(at.z() == Approx(one.height).margin(1e-12));
  }
  CHECK(held[0].bound_points[0].part == 1);
  CHECK(held[1].bound_points[0].part == 0);

  // The same again is nothing new, until it is forgotten.
  CHECK_FALSE(watch.hold(0, points, ActiveExtentConstraints::OnExchange::keep));
  CHECK_FALSE(watch.hold(0, points, ActiveExtentConstraints::OnExchange::release));
  watch.release();
  CHECK(watch.constraints(transfer).empty());
  CHECK(watch.hold(0, points, ActiveExtentConstraints::OnExchange::release));

  // With the top 1 higher, legs that grow by 1 reach into the excess as well.
  watch.release();
  for (const int v : groups[0]) points(v, 2) += 0.75;
  for (const int v : groups[1])
    if (points(v, 2) == 5.5) points(v, 2) += 1;
  CHECK(watch.hold(0, points, ActiveExtentConstraints::OnExchange::keep));
  CHECK(watch.constraints(transfer).size() == 3);
}

TEST_CASE("another outermost vertex joins the held ones of its group, or takes their place") {
  const StructuredShape box = structures::box_alone({2, 2, 2});
  const Rig rig(box.structure);
  const MeshTransfer transfer(box.shape, rig);
  const auto groups = vertices_by_class(box.shape, rig);
  Points first = box.shape.vertices, second = first;
  Eigen::Index a = 0, b = 0;
  (first * Eigen::Vector3d(1, 1, 2)).maxCoeff(&a);
  (first * Eigen::Vector3d(-1, -1, 2)).maxCoeff(&b);
  REQUIRE(a != b);
  first(a, 2) += 0.5;
  second(b, 2) += 0.5;
  for (const auto on_exchange :
       {ActiveExtentConstraints::OnExchange::keep, ActiveExtentConstraints::OnExchange::release}) {
    ActiveExtentConstraints watch(groups, extent_bounds(box.shape, keeping({0, 0, 1})));
    REQUIRE(watch.hold(0, first, on_exchange));
    CHECK(watch.constraints(transfer).size() == 2);
    REQUIRE(watch.hold(0, second, on_exchange));
    CHECK(watch.constraints(transfer).size() ==
          (on_exchange == ActiveExtentConstraints::OnExchange::keep ? 3 : 2));
    // Back to the first: nothing that was not held before.
    CHECK_FALSE(watch.hold(0, first, on_exchange));
  }
}

TEST_CASE("fixed ends are held at their heights, without a level to choose") {
  const StructuredShape box = structures::box_alone({2, 2, 2});
  const Rig rig(box.structure);
  const MeshTransfer transfer(box.shape, rig);
  const auto groups = vertices_by_class(box.shape, rig);
  ActiveExtentConstraints watch(groups, extent_bounds(box.shape, keeping({0, 0, 1}, ExtentEnds::fixed)));
  Points points = box.shape.vertices;
  points.col(2) *= 1.5;
  CHECK(watch.excess(0, points) == Approx(0.5).epsilon(1e-14));
  REQUIRE(watch.hold(0, points, ActiveExtentConstraints::OnExchange::keep));
  const std::vector<Constraint> held = watch.constraints(transfer);
  REQUIRE(held.size() == 2);
  CHECK(held[0].height == -1);
  CHECK(held[1].height == 1);
  for (const Constraint& one : held) CHECK_FALSE(one.level);
}

}  // namespace stackabilization::extent_bounds_test
