#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "stackabilization/core/errors.h"
#include "stackabilization/stacking/clearance.h"
#include "stackabilization/stacking/map.h"
#include "stackabilization/stacking/search.h"
#include "stackabilization/stacking/stackability.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

std::vector<solids::NamedShape> shapes() {
  return {{"cup", solids::frustum_shell({.segments = 16})},
          {"tetrahedron",
           solids::tetrahedron({Eigen::Vector3d(0, 0, 0), {2, 0.1, 0.3}, {0.2, 1.5, 0}, {0.5, 0.4, 1}})},
          {"torus", solids::torus({.ring_segments = 12, .tube_segments = 8})},
          {"soup", solids::triangle_soup({.seed = 3, .count = 40})}};
}

const std::vector<Eigen::Vector3d> directions = {{0.1, 0.2, 1}, {1, -0.3, 0.2}, {-0.4, 1, 0.7}};

double s(const Shape& shape, const Eigen::Vector3d& r, const StackabilityOptions& options = {}) {
  return stackability(shape, Direction(r), options).value;
}

/// Walls swept along (1, 2, 3) over a square, without bottom or top; every corner has small integers.
Shape slanted_tube() {
  Points vertices(8, 3);
  for (int i = 0; i < 4; ++i) {
    const Eigen::RowVector3d corner(i == 1 || i == 2, i == 2 || i == 3, 0);
    vertices.row(i) = corner;
    vertices.row(i + 4) = corner + Eigen::RowVector3d(1, 2, 3);
  }
  Triangles triangles(8, 3);
  for (int i = 0; i < 4; ++i) {
    const int next = (i + 1) % 4;
    triangles.row(2 * i) << i, next, next + 4;
    triangles.row(2 * i + 1) << i, next + 4, i + 4;
  }
  return make_shape(vertices, triangles);
}

}  // namespace

TEST_CASE("a box does not stack: S is 0 along its axes in every model and semantics") {
  const Shape box = solids::box({1, 2, 3});
  for (const ContactSemantics semantics : {ContactSemantics::solid, ContactSemantics::closed})
    for (const BoxModel boxes : {BoxModel::oriented, BoxModel::frame})
      for (int axis = 0; axis < 3; ++axis) {
        const Stackability result =
            stackability(box, Direction(Eigen::Vector3d::Unit(axis)), {semantics, boxes});
        CHECK(result.value == Approx(0).margin(1e-12));
        CHECK(result.f_max == Approx(axis + 1).epsilon(1e-12));
        CHECK(result.extent == Approx(axis + 1).epsilon(1e-14));
        CHECK(result.box_volume == Approx(6).epsilon(1e-12));
        CHECK(result.stack_box_volume() == Approx(6).epsilon(1e-12));
      }
}

TEST_CASE("a cube along its diagonal has S = -3") {
  // f_max = sqrt 3 = h; the projection is a hexagon of side sqrt(2/3) in a rectangle of area 4 / sqrt 3.
  CHECK(s(solids::box({1, 1, 1}), {2, 2, 2}) == Approx(-3).epsilon(1e-12));
}

TEST_CASE("a stack along a leaning direction drifts by the sine of its angle") {
  const Stackability leaning = stackability(solids::box({1, 1, 1}), Direction(1.5, 0, 2));
  CHECK(leaning.f_max == Approx(1.25));
  CHECK(leaning.stack_drift(1) == 0);
  CHECK(leaning.stack_drift(5) == Approx(4 * 0.75));
  CHECK(stackability(solids::box({1, 1, 1}), Direction(0, 0, 2)).stack_drift(7) == 0);
}

TEST_CASE("a cup along its axis in closed form") {
  const solids::FrustumShell cup;
  const double f_max = solids::frustum_shell_f_max(cup);
  const Stackability framed = stackability(solids::frustum_shell(cup), Direction(0, 0, 1),
                                           {ContactSemantics::solid, BoxModel::frame});
  CHECK(framed.value == Approx(1 - f_max / cup.height).epsilon(1e-12));
  CHECK(framed.box_volume == Approx(8 * 8 * 8).epsilon(1e-14));

  const Stackability oriented = stackability(solids::frustum_shell(cup), Direction(0, 0, 1));
  const double side = 2 * cup.outer_top * std::cos(std::numbers::pi / cup.segments);
  CHECK(oriented.stack_box_volume() == Approx(side * side * cup.height).epsilon(1e-12));
  CHECK(oriented.box_volume <= oriented.stack_box_volume() * (1 + 1e-12));
  CHECK(oriented.value == Approx(1 - f_max * side * side / oriented.box_volume).epsilon(1e-12));
}

TEST_CASE("S does not depend on the pose, the size or the length and sign of r") {
  for (const auto& [name, shape] : shapes())
    for (const Eigen::Vector3d& r : directions) {
      INFO(name);
      const double value = s(shape, r);
      for (std::uint64_t seed = 0; seed < 3; ++seed) {
        const Eigen::Matrix3d rotation = solids::random_rotation(seed);
        const Shape turned = transformed(shape, 0.01 * rotation, Eigen::Vector3d(0.3, -0.1, 0.2));
        CHECK(s(turned, rotation * r) == Approx(value).margin(1e-9));
      }
      CHECK(s(shape, -r) == Approx(value).margin(1e-12));
      CHECK(s(shape, 1000 * r) == Approx(value).margin(1e-12));
    }
}

TEST_CASE("S does not depend on how the surface is cut and listed") {
  for (const BoxModel boxes : {BoxModel::oriented, BoxModel::frame})
    for (const auto& [name, shape] : shapes())
      for (const Eigen::Vector3d& r : directions) {
        INFO(name);
        const StackabilityOptions options{ContactSemantics::solid, boxes};
        const double value = s(shape, r, options);
        CHECK(s(solids::permuted(shape, 5), r, options) == Approx(value).margin(1e-12));
        CHECK(s(solids::flipped(shape), r, options) == Approx(value).margin(1e-12));
        CHECK(s(solids::subdivided(shape), r, options) == Approx(value).margin(1e-9));
      }
}

TEST_CASE("f_max of a measurement is the exact one") {
  for (const auto& [name, shape] : shapes()) {
    INFO(name);
    const StackabilitySolver solver(shape);
    for (const Eigen::Vector3d& r : directions) {
      const Stackability result = solver.measure(Direction(r));
      CHECK(result.f_max == Approx(solver.separation(Direction(r)).length).margin(1e-12 * result.extent));
      CHECK(result.direction == r);
      CHECK(result.value ==
            Approx(1 - result.f_max / result.extent * result.stack_box_volume() / result.box_volume)
                .margin(1e-12));
    }
  }
}

TEST_CASE("a measurement is given up only below its threshold") {
  for (const BoxModel boxes : {BoxModel::oriented, BoxModel::frame})
    for (const auto& [name, shape] : shapes()) {
      INFO(name);
      const StackabilitySolver solver(shape, {ContactSemantics::solid, boxes});
      for (const Eigen::Vector3d& r : directions) {
        const double value = solver.measure(Direction(r)).value;
        for (const double below : {1e-10, 1e-3, 1.0, 100.0}) {
          const auto found = solver.measure_if_above(Direction(r), value - below);
          REQUIRE(found);
          CHECK(found->value == Approx(value).margin(1e-12));
          CHECK_FALSE(solver.measure_if_above(Direction(r), value + below));
        }
        std::int64_t pairs = -1;
        CHECK(solver.measure_if_above(Direction(r), -std::numeric_limits<double>::infinity(), pairs)->value ==
              value);
        CHECK(pairs == separation_enclosure(solver.tree(), solver.tree(), Direction(r)).work.node_pairs);
        CHECK_FALSE(solver.measure_if_above(Direction(r), 2, pairs));
        CHECK(pairs == 0);  // S is at most 1
      }
    }
}

TEST_CASE("a tube of sheets slides into itself along its walls, unless touching counts") {
  const Shape tube = slanted_tube();
  const Stackability open = stackability(tube, Direction(1, 2, 3));
  CHECK(open.f_max == 0);
  CHECK(open.value == 1);
  CHECK(stackability(tube, Direction(1, 2, 3), {ContactSemantics::closed, BoxModel::oriented}).f_max ==
        Approx(std::sqrt(14)).epsilon(1e-12));
}

TEST_CASE("a flat shape has no stackability") {
  Points corners(3, 3);
  corners << 0, 0, 0, 1, 2, 0, 0, 1, 1;
  Triangles triangle(1, 3);
  triangle << 0, 1, 2;
  const Shape flat = make_shape(corners, triangle);
  CHECK_THROWS_AS(StackabilitySolver(flat), InputError);
  CHECK_THROWS_AS(StackabilitySolver(transformed(flat, solids::random_rotation(1), Eigen::Vector3d::Ones())),
                  InputError);
  CHECK_THROWS_AS(StackabilitySolver(Shape{}), InputError);

  StackabilityOptions options;
  options.flat_shapes = FlatShapes::measure;
  const StackabilitySolver solver(flat, options);
  const Stackability measured = solver.measure(Direction(0, 0, 1));
  CHECK(solver.box_volume() == 0);
  CHECK(measured.f_max == 0);
  CHECK(measured.extent == 1);
  CHECK(std::isnan(measured.value));
  CHECK_THROWS_AS(best_direction(solver), UsageError);
  CHECK_THROWS_AS(stackability_map(solver), UsageError);
}

TEST_CASE("Eq. 3 and its inverse agree with what is measured, for any translation") {
  for (const BoxModel boxes : {BoxModel::frame, BoxModel::oriented})
    for (const Direction& r : {Direction(0, 0, 1), Direction(0.3, -0.2, 1), Direction(-2, 0.1, 0.4)}) {
      StackabilityOptions options;
      options.boxes = boxes;
      const Stackability measured = stackability(solids::frustum_shell({}), r, options);
      CHECK(measured.value_at(measured.f_max) == measured.value);
      CHECK(measured.value_at(0) == 1);
      CHECK(measured.value_at(measured.extent) ==
            Approx(1 - measured.stack_box_volume() / measured.box_volume).epsilon(1e-14));
      for (const double value : {-0.5, 0.0, 0.3, 0.99}) {
        const double f = measured.translation_for(value);
        CHECK(measured.value_at(f) == Approx(value).margin(1e-14));
        CHECK(measured.with_f_max(f).value == measured.value_at(f));
        CHECK(1 - f * measured.loss_per_length() == Approx(value).margin(1e-14));
      }
    }
}

TEST_CASE("clearance adds to f_max, play is that of separation_with_play, in every way of measuring") {
  const Shape cup = solids::frustum_shell({});
  const Direction r(0.1, 0, 1);
  PlayOptions play;
  play.play = 0.05;
  const double apart = separation_with_play(cup, cup, r, play).length;
  StackabilityOptions options;
  options.clearance = 0.25;
  options.play = 0.05;
  const StackabilitySolver solver(cup, options);
  const ExactStackability exact = solver.measure_exact(r);
  CHECK(exact.separation.length == Approx(separation(solver.tree(), solver.tree(), r).length));
  CHECK(exact.stackability.f_max == apart + 0.25);
  CHECK(exact.stackability.value == exact.stackability.value_at(apart + 0.25));
  CHECK(solver.measure(r).f_max == apart + 0.25);
  CHECK(stackability(cup, r, options).f_max == apart + 0.25);
  CHECK(measure_exact(cup, solver.tree(), r, options).stackability.f_max == apart + 0.25);
  const double value = solver.measure(r).value;
  CHECK(solver.measure_if_above(r, value));
  CHECK_FALSE(solver.measure_if_above(r, value + 1e-9));
  CHECK_FALSE(stackability_if_above(cup, r, value + 1e-9, options));
  for (const double bad : {-1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    StackabilityOptions wrong;
    wrong.clearance = bad;
    CHECK_THROWS_AS(StackabilitySolver(cup, wrong), UsageError);
    wrong = {};
    wrong.play = bad;
    CHECK_THROWS_AS(stackability(cup, r, wrong), UsageError);
  }
}

TEST_CASE("solvers that share a shape differ in play only, and the box is that of V(M)") {
  for (const BoxModel boxes : {BoxModel::oriented, BoxModel::frame})
    for (const auto& [name, shape] : shapes()) {
      CAPTURE(name, boxes == BoxModel::frame);
      StackabilityOptions options;
      options.boxes = boxes;
      options.clearance = 0.25;
      const StackabilitySolver solver(shape, options);
      CHECK(solver.box().volume() == solver.box_volume());
      CHECK(solver.box_volume() == box_volume(solver.hull(), boxes));
      options.play = 0.02;
      const StackabilitySolver alone(shape, options), sharing = solver.with_play(options.play);
      CHECK(&sharing.tree() == &solver.tree());
      CHECK(sharing.options().play == options.play);
      const Direction direction(0.1, 0.2, 1);
      CHECK(sharing.measure(direction).value == alone.measure(direction).value);
      CHECK(sharing.with_play(0).measure(direction).value == solver.measure(direction).value);
    }
  CHECK_THROWS_AS(StackabilitySolver(shapes().front().shape).with_play(-1), UsageError);
}
