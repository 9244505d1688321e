#include <cmath>
#include <limits>
#include <numbers>

#include "stackabilization/core/errors.h"
#include "stackabilization/mesh/boxes.h"
#include "stackabilization/stacking/clearance.h"
#include "stackabilization/stacking/stack.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

StackOptions stack_of(int n) {
  StackOptions options;
  options.copies = n;
  return options;
}

/// A column of height 1 on the axis and a post of the given height beside it: turned by half, the post misses
/// the next copy but stands in the way of the one after that.
Shape stair(double post_height) {
  return concatenate(solids::box({-0.5, -0.5, 0}, {0.5, 0.5, 1}),
                     solids::box({1.5, -0.5, 0}, {2.5, 0.5, post_height}));
}

StackOptions half_turns(int n) {
  StackOptions options = stack_of(n);
  options.twist_degrees = 180;
  options.axis_point = Eigen::Vector3d::Zero();
  return options;
}

std::vector<double> offsets(const StackResult& stack) {
  std::vector<double> lengths;
  for (const StackedCopy& copy : stack.copies) lengths.push_back(copy.offset_length);
  return lengths;
}

}  // namespace

TEST_CASE("cubes fill their box") {
  const Shape cube = solids::box({1, 1, 1});
  for (const BoxModel boxes : {BoxModel::oriented, BoxModel::frame}) {
    StackOptions options = stack_of(5);
    options.boxes = boxes;
    const StackResult stack = stack_copies(cube, Direction(0, 0, 2), options);
    REQUIRE(stack.copies.size() == 5);
    for (int k = 0; k < 5; ++k) {
      const StackedCopy& copy = stack.copies[static_cast<std::size_t>(k)];
      CHECK(copy.offset == Rational(0.5 * k));
      CHECK(copy.offset_length == k);
      CHECK(copy.rests_on == k - 1);
    }
    CHECK(stack.height == 5);
    CHECK(stack.increment == 1);
    CHECK(stack.stack_volume == Approx(5));
    CHECK(stack.stackability == Approx(0).margin(1e-9));
    CHECK(stack.conflicts.empty());
    CHECK(stack.conflict_height == 0);
  }
}

TEST_CASE("a translated stack obeys Eq. 2, and Eq. 3 in the limit") {
  const solids::FrustumShell cup;
  const Shape shape = solids::frustum_shell(cup);
  const double f_max = solids::frustum_shell_f_max(cup), height = cup.height;
  for (const BoxModel boxes : {BoxModel::oriented, BoxModel::frame}) {
    StackOptions options = stack_of(7);
    options.boxes = boxes;
    const StackResult seven = stack_copies(shape, upwards, options);
    CHECK(seven.increment == Approx(f_max));
    CHECK(seven.height == Approx(height + 6 * f_max));
    const double along = boxes == BoxModel::frame ? frame_box(shape.vertices, upwards).volume()
                                                  : HullSupport(shape).box_along(upwards).volume();
    const double eq_2 = (1 + 6 * f_max / height) * along;
    CHECK(seven.stack_volume == Approx(eq_2));
    const double eq_3 = 1 - f_max / height * along / seven.box_volume;
    double previous = 1;
    for (const int n : {10, 100, 1000, 10000}) {
      options.copies = n;
      const double difference = std::abs(stack_copies(shape, upwards, options).stackability - eq_3);
      CHECK(difference < 1.0 / n);
      CHECK(difference < previous);
      previous = difference;
    }
  }
}

TEST_CASE("one copy is its own box, and its increment is f_max") {
  const Shape shape = solids::l_shape(2, 1);
  const StackResult stack = stack_copies(shape, Direction(1, 0, 1), stack_of(1));
  CHECK(stack.stackability == Approx(0).margin(1e-9));
  CHECK(stack.increment == Approx(solids::l_shape_f_max(2, 1, Direction(1, 0, 1)) * std::numbers::sqrt2));
}

TEST_CASE("a twisted square bin climbs by the support of its square") {
  // Walls of slope 2: outer apothem 1 + z / 2, inner 1/2 + z / 2, rim at z = 6. Turned by a, the outer square
  // reaches (cos a + sin a) times its apothem against the inner faces and stops at the rim: z = 8 - 7 / (cos
  // a + sin a).
  const double corner = std::numbers::sqrt2;
  const Shape bin = solids::frustum_shell({corner, 4 * corner, 0.75 * corner, 3.5 * corner, 6, 0.5, 4});
  for (const double degrees : {0.0, 10.0, 45.0, -30.0}) {
    StackOptions options = stack_of(4);
    options.twist_degrees = degrees;
    const double a = std::abs(degrees) * std::numbers::pi / 180;
    const double step = 8 - 7 / (std::cos(a) + std::sin(a));
    const StackResult stack = stack_copies(bin, upwards, options);
    CAPTURE(degrees);
    for (int k = 0; k < 4; ++k)
      CHECK(stack.copies[static_cast<std::size_t>(k)].offset_length == Approx(k * step).epsilon(1e-9));
    CHECK(stack.increment == Approx(step).epsilon(1e-9));
  }
}

TEST_CASE("copies that are not neighbours collide, and are seen") {
  const StackResult stack = stack_copies(stair(3.5), upwards, half_turns(6));
  CHECK(offsets(stack) == std::vector<double>{0, 1, 3.5, 4.5, 7, 8});
  CHECK(stack.copies[2].offset == Rational(3.5));
  CHECK(stack.copies[2].rests_on == 0);
  CHECK(stack.copies[3].rests_on == 2);
  CHECK(stack.increment == 1.75);
  REQUIRE(stack.conflicts.size() == 4);
  for (int i = 0; i < 4; ++i) {
    const StackConflict& conflict = stack.conflicts[static_cast<std::size_t>(i)];
    CHECK(conflict.below == i);
    CHECK(conflict.above == i + 2);
    CHECK(conflict.overlap == 1.5);
  }
  CHECK(stack.height == 11.5);
  CHECK(stack.conflict_height == 3);
}

TEST_CASE("a post that its column clears in time is no conflict") {
  const StackResult stack = stack_copies(stair(2), upwards, half_turns(6));
  CHECK(offsets(stack) == std::vector<double>{0, 1, 2, 3, 4, 5});
  CHECK(stack.conflicts.empty());
  CHECK(stack.conflict_height == 0);
  CHECK(stack.copies[2].rests_on == 1);
}

TEST_CASE("a conflict is more than rounding") {
  for (const double excess : {1e-14, 1e-12}) {
    const StackResult stack = stack_copies(stair(2 + excess), upwards, half_turns(6));
    CHECK(stack.conflicts.empty());
    CHECK(stack.conflict_height == 0);
    CHECK(stack.copies[2].offset > Rational(2));
  }
  const StackResult stack = stack_copies(stair(2 + 1e-6), upwards, half_turns(6));
  CHECK(stack.conflicts.size() == 4);
  CHECK(stack.conflict_height == Approx(2e-6).epsilon(1e-6));
}

TEST_CASE("a clearance beside which the shape drowns in rounding is refused") {
  const Shape cube = solids::box({1, 1, 1});
  for (const BoxModel boxes : {BoxModel::oriented, BoxModel::frame}) {
    StackOptions options = stack_of(3);
    options.boxes = boxes;
    options.clearance = 1e9;
    CHECK(stack_copies(cube, upwards, options).stack_volume == Approx(2e9 + 3).epsilon(1e-12));
    for (const double clearance : {1e15, 1e40, 1e60, 1e61, 1e308}) {
      options.clearance = clearance;
      CHECK_THROWS_AS(stack_copies(cube, upwards, options), UsageError);
    }
  }
}

TEST_CASE("copies that pass each other stand on one floor") {
  const Shape post = solids::box({1.5, -0.5, 2}, {2.5, 0.5, 5});
  StackOptions options = half_turns(5);
  options.twist_degrees = 90;
  const StackResult stack = stack_copies(post, upwards, options);
  CHECK(offsets(stack) == std::vector<double>{0, 0, 0, 0, 3});
  CHECK(stack.copies[3].rests_on == -1);
  CHECK(stack.copies[4].rests_on == 0);
  CHECK(stack.increment == 0.75);
  REQUIRE(stack.conflicts.size() == 1);
  CHECK(stack.conflicts[0].overlap == 3);
}

TEST_CASE("a lift in the given transforms does not change the stack") {
  const Shape cube = solids::box({1, 1, 1});
  for (const double lift : {-3.0, 0.0, 5.0}) {
    StackOptions options = stack_of(6);
    options.poses = powers({Eigen::Matrix3d::Identity(), {0.25, 0, lift}}, 6);
    const StackResult stack = stack_copies(cube, upwards, options);
    for (int k = 0; k < 6; ++k)
      CHECK(stack.copies[static_cast<std::size_t>(k)].offset_length == k * (1 - lift));
    CHECK(stack.height == 6);
  }
}

TEST_CASE("sliding contact is free for solids and blocks in closed semantics") {
  const Shape cube = solids::box({1, 1, 1});
  StackOptions options = stack_of(3);
  options.poses = powers({Eigen::Matrix3d::Identity(), {1, 0, 0}}, 3);
  CHECK(stack_copies(cube, upwards, options).height == 1);
  options.semantics = ContactSemantics::closed;
  CHECK(stack_copies(cube, upwards, options).height == 3);
}

TEST_CASE("every copy is clear of all earlier ones and touches the one it rests on") {
  const Direction r(0.2, -0.1, 1);
  solids::Random random(3);
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Shape shape = solids::triangle_soup({.seed = seed, .count = 20, .size = 0.8});
    StackOptions options = stack_of(8);
    options.twist_degrees = seed % 2 == 0 ? 37 : 0;
    for (int k = 0; k < 3; ++k)
      options.poses.push_back({solids::random_rotation(10 * seed + k), random.in_cube()});
    const StackResult stack = stack_copies(shape, r, options);
    for (std::size_t k = 1; k < stack.copies.size(); ++k) {
      const Shape above = transformed(shape, stack.copies[k].transform);
      double most = -std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j < k; ++j) {
        const Shape below = transformed(shape, stack.copies[j].transform);
        const double demand = stack.copies[j].offset_length +
                              separation(SeparationTree(below), SeparationTree(above), r).length;
        if (static_cast<int>(j) == stack.copies[k].rests_on)
          CHECK(demand == Approx(stack.copies[k].offset_length).margin(1e-9));
        most = std::max(most, demand);
      }
      CHECK(most <= stack.copies[k].offset_length + 1e-9);
      if (stack.copies[k].rests_on < 0)
        CHECK((above.vertices * r.unit()).minCoeff() + stack.copies[k].offset_length ==
              Approx((transformed(shape, stack.copies[0].transform).vertices * r.unit()).minCoeff())
                  .margin(1e-9));
    }
    CHECK(stacked_shape(shape, r, stack).vertices.rows() == 8 * shape.vertex_count());
    const Eigen::VectorXd heights = stacked_shape(shape, r, stack).vertices * r.unit();
    CHECK(heights.maxCoeff() - heights.minCoeff() == Approx(stack.height).epsilon(1e-9));
  }
}

TEST_CASE("the long-run increment is the slope of a very long stack") {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Shape shape = solids::triangle_soup({.seed = seed, .count = 8, .size = 0.7});
    StackOptions options = stack_of(3001);
    for (int k = 0; k < 3; ++k)
      options.poses.push_back({solids::random_rotation(7 * seed + k), Eigen::Vector3d::Zero()});
    const StackResult stack = stack_copies(shape, upwards, options);
    const int window = 2520;
    CHECK(stack.increment * window ==
          Approx(stack.copies[3000].offset_length - stack.copies[3000 - window].offset_length));
  }
}

TEST_CASE("equal poses and full turns change nothing") {
  const Shape cup = solids::frustum_shell({});
  StackOptions options = stack_of(5);
  const StackResult straight = stack_copies(cup, upwards, options);
  options.poses = std::vector<RigidTransform>(5);
  const StackResult listed = stack_copies(cup, upwards, options);
  options.poses.clear();
  options.twist_degrees = 720;
  const StackResult turned = stack_copies(cup, upwards, options);
  for (std::size_t k = 0; k < 5; ++k) {
    CHECK(listed.copies[k].offset == straight.copies[k].offset);
    CHECK(turned.copies[k].offset == straight.copies[k].offset);
  }
  CHECK(listed.stack_volume == straight.stack_volume);
  CHECK(turned.increment == straight.increment);
}

TEST_CASE("the box of the stack is the box of its union") {
  const Shape shape = solids::triangle_soup({.seed = 5, .count = 30});
  StackOptions options = stack_of(6);
  options.twist_degrees = 25;
  options.poses = {{}, rotation_about({Eigen::Vector3d::Zero(), Direction(1, 0, 0)}, 180)};
  for (const BoxModel boxes : {BoxModel::oriented, BoxModel::frame}) {
    options.boxes = boxes;
    const StackResult stack = stack_copies(shape, upwards, options);
    const Shape all = stacked_shape(shape, upwards, stack);
    const double expected = boxes == BoxModel::frame ? frame_box(all.vertices, upwards).volume()
                                                     : minimal_oriented_box(HullSupport(all)).volume();
    CHECK(stack.stack_volume == Approx(expected).epsilon(1e-9));
    CHECK(stack.stackability == Approx(1 - expected / (6 * stack.box_volume)));
  }
}

TEST_CASE("clearance and play widen each step") {
  StackOptions options = stack_of(4);
  options.clearance = 0.125;
  CHECK(offsets(stack_copies(solids::box({1, 1, 1}), upwards, options)) ==
        std::vector<double>{0, 1.125, 2.25, 3.375});
  const Shape cup = solids::frustum_shell({});
  options.clearance = 0;
  options.play = 0.1;
  const double step = separation_with_play(cup, cup, upwards, {0.1}).length;
  const StackResult stack = stack_copies(cup, upwards, options);
  CHECK(step > solids::frustum_shell_f_max({}));
  CHECK(stack.copies[3].offset_length == Approx(3 * step));
  CHECK(stack.increment == Approx(step));
  options.twist_degrees = 20;
  CHECK(stack_copies(cup, upwards, options).copies[3].offset_length >= 3 * solids::frustum_shell_f_max({}));
}

TEST_CASE("the stack as a shape names every part of every copy") {
  Shape shape = stair(2);
  shape.part_names = {"column", "post"};
  shape.unit = Unit::centimetre;
  const Shape all = stacked_shape(shape, upwards, stack_copies(shape, upwards, half_turns(2)));
  CHECK_NOTHROW(validate(all));
  CHECK(all.part_names ==
        std::vector<std::string>{"copy1/column", "copy1/post", "copy2/column", "copy2/post"});
  CHECK(all.unit == Unit::centimetre);
  CHECK(extract_part(all, 3).vertices.col(0).maxCoeff() == -1.5);
  CHECK(extract_part(all, 3).vertices.col(2).minCoeff() == 1);
}

TEST_CASE("stacks refuse what is not a stack") {
  const Shape cube = solids::box({1, 1, 1});
  CHECK_THROWS_AS(stack_copies(cube, upwards, stack_of(0)), UsageError);
  CHECK_THROWS_AS(stack_copies(cube, upwards, stack_of(10001)), UsageError);
  const auto refused = [&](auto change) {
    StackOptions options = stack_of(2);
    change(options);
    CHECK_THROWS_AS(stack_copies(cube, upwards, options), UsageError);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused([&](StackOptions& o) { o.twist_degrees = nan; });
  refused([&](StackOptions& o) { o.clearance = -1; });
  refused([&](StackOptions& o) { o.play = -1; });
  refused([&](StackOptions& o) { o.axis_point = Eigen::Vector3d(0, 0, nan); });
  refused([&](StackOptions& o) { o.poses = {{2 * Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()}}; });
  refused([&](StackOptions& o) { o.poses = powers({Eigen::Matrix3d::Identity(), {1, 0, 0}}, 1001); });
  CHECK_THROWS_AS(stack_copies(Shape{}, upwards, stack_of(2)), InputError);
  Shape flat = cube;
  flat.vertices.col(2).setZero();
  CHECK_THROWS_AS(stack_copies(flat, upwards, stack_of(2)), InputError);
}
