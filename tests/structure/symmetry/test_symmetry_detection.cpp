#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "stackabilization/core/errors.h"
#include "stackabilization/structure/symmetry_detection.h"
#include "structure/symmetry/symmetry_refinement.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/symmetric_solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

std::vector<FoundSymmetry> of_kind(const std::vector<FoundSymmetry>& found, SymmetryKind kind) {
  std::vector<FoundSymmetry> result;
  std::copy_if(found.begin(), found.end(), std::back_inserter(result),
               [&](const FoundSymmetry& each) { return each.symmetry.kind == kind; });
  return result;
}

int count_of_kind(const std::vector<FoundSymmetry>& found, SymmetryKind kind) {
  return static_cast<int>(of_kind(found, kind).size());
}

/// Is the plane through `point` with normal `axis` among the reflections? Both to `accuracy`, angles in
/// radians.
bool has_plane(const std::vector<FoundSymmetry>& found, const Eigen::Vector3d& point,
               const Eigen::Vector3d& axis, double accuracy) {
  return std::any_of(found.begin(), found.end(), [&](const FoundSymmetry& each) {
    const Symmetry& symmetry = each.symmetry;
    return symmetry.kind == SymmetryKind::reflection &&
           symmetry.axis.cross(axis.normalized()).norm() <= accuracy &&
           std::abs(symmetry.axis.dot(point - symmetry.point)) <= accuracy;
  });
}

bool has_order(const std::vector<FoundSymmetry>& found, int order, const Eigen::Vector3d& axis) {
  return std::any_of(found.begin(), found.end(), [&](const FoundSymmetry& each) {
    return each.symmetry.kind == SymmetryKind::rotation && each.symmetry.order == order &&
           each.symmetry.axis.cross(axis.normalized()).norm() <= 1e-6;
  });
}

}  // namespace

TEST_CASE("a reach whose square underflows refines to a finite plane, that of the box") {
  const detail::SymmetrySurface surface = detail::symmetry_surface(solids::box({1, 2, 3}), 200);
  Symmetry start;
  start.axis = Eigen::Vector3d::UnitX();
  for (const double reach : {1e-300, 1e-170, 1e-12}) {
    const Symmetry all = detail::refine_symmetry(surface, start, reach);
    const Symmetry one = detail::step_symmetry(surface, start, reach, detail::Effort::sparse);
    for (const Symmetry& symmetry : {all, one}) {
      CHECK(symmetry.axis.cross(start.axis).norm() <= 1e-9);
      CHECK(symmetry.point.norm() <= 1e-9);
    }
  }
}

TEST_CASE("a box has the three planes through its middle, longest extent first, and three half turns") {
  const auto found = find_symmetries(solids::box({1, -1, 2}, {3, 2, 6}));  // 2 x 3 x 4
  REQUIRE(found.size() == 6);
  const Eigen::Vector3d middle(2, 0.5, 4);
  for (int k = 0; k < 3; ++k) {
    const Symmetry& plane = found[static_cast<std::size_t>(k)].symmetry;
    CHECK(plane.kind == SymmetryKind::reflection);
    CHECK(plane.axis.cross(Eigen::Vector3d::Unit(2 - k)).norm() <= 1e-9);
    CHECK(std::abs(plane.axis.dot(plane.point - middle)) <= 1e-9);
    CHECK(has_order(found, 2, Eigen::Vector3d::Unit(k)));
  }
  for (const FoundSymmetry& each : found) {
    CHECK(each.residual <= 1e-9);
    CHECK(each.support == 1);
  }
}

TEST_CASE("a square prism has five planes, a cube nine, and the rotations that follow") {
  const auto prism = find_symmetries(solids::box({2, 2, 5}));
  CHECK(count_of_kind(prism, SymmetryKind::reflection) == 5);
  CHECK(has_plane(prism, {1, 1, 0}, {1, 1, 0}, 1e-9));
  CHECK(has_plane(prism, {1, 1, 0}, {1, -1, 0}, 1e-9));
  CHECK(has_order(prism, 4, {0, 0, 1}));
  CHECK(count_of_kind(prism, SymmetryKind::rotation) == 5);

  const auto cube = find_symmetries(solids::box({2, 2, 2}));
  CHECK(count_of_kind(cube, SymmetryKind::reflection) == 9);
  CHECK(count_of_kind(cube, SymmetryKind::rotation) == 3 + 4 + 6);
  CHECK(has_order(cube, 4, {1, 0, 0}));
  CHECK(has_order(cube, 3, {1, -1, 1}));
  CHECK(has_order(cube, 2, {1, 1, 0}));
}

TEST_CASE("a prism over a regular polygon has a plane per side and one across") {
  for (const int sides : {3, 5, 6, 12}) {
    CAPTURE(sides);
    const auto found = find_symmetries(solids::cylinder(1, 1.5, sides));
    CHECK(count_of_kind(found, SymmetryKind::reflection) == sides + 1);
    CHECK(count_of_kind(found, SymmetryKind::revolution) == 0);
    CHECK(has_plane(found, {0, 0, 0.75}, {0, 0, 1}, 1e-8));
    for (int k = 0; k < sides; ++k) {
      const double angle = std::numbers::pi * k / sides + std::numbers::pi / 2;
      CHECK(has_plane(found, {0, 0, 0}, {std::cos(angle), std::sin(angle), 0}, 1e-7));
    }
    CHECK(has_order(found, sides, {0, 0, 1}));
  }
}

TEST_CASE("what is round is a revolution and not a heap of planes") {
  for (const int segments : {16, 17, 64}) {
    CAPTURE(segments);
    const auto cylinder = find_symmetries(solids::cylinder(1, 3, segments));
    CHECK(cylinder.size() == 2);
    CHECK(has_plane(cylinder, {0, 0, 1.5}, {0, 0, 1}, 1e-8));
    REQUIRE(count_of_kind(cylinder, SymmetryKind::revolution) == 1);
    const Symmetry axis = cylinder.back().symmetry;
    CHECK(axis.axis.cross(Eigen::Vector3d::UnitZ()).norm() <= 1e-8);
    CHECK(axis.point.head<2>().norm() <= 1e-8);
  }
  const auto cup = find_symmetries(solids::frustum_shell({}));
  CHECK(cup.size() == 1);
  CHECK(count_of_kind(cup, SymmetryKind::revolution) == 1);
  const auto sphere = find_symmetries(solids::sphere(1, 3));
  CHECK(count_of_kind(sphere, SymmetryKind::revolution) == 3);
  CHECK(count_of_kind(sphere, SymmetryKind::reflection) == 3);
}

TEST_CASE("a handle leaves a cup the plane through it") {
  const auto found = find_symmetries(solids::cup_with_handle());
  REQUIRE(found.size() == 1);
  CHECK(has_plane(found, {0, 0, 0}, {0, 1, 0}, 1e-7));
}

TEST_CASE("a chair has its plane, with a label on one side as well") {
  CHECK(has_plane(find_symmetries(solids::chair()), {0, 0, 0}, {1, 0, 0}, 1e-9));
  CHECK(find_symmetries(solids::chair()).size() == 1);
  const Shape label = solids::box({1.5, -1, 4.5}, {1.9, 0, 4.55});
  const auto found = find_symmetries(concatenate(solids::chair(), label));
  REQUIRE(found.size() == 1);
  CHECK(has_plane(found, {0, 0, 0}, {1, 0, 0}, 1e-7));
}

TEST_CASE("a twisted bar has rotations but no reflection") {
  const auto found = find_symmetries(solids::twisted_bar());
  CHECK(count_of_kind(found, SymmetryKind::reflection) == 0);
  CHECK(count_of_kind(found, SymmetryKind::revolution) == 0);
  CHECK(has_order(found, 2, {0, 0, 1}));
  CHECK(count_of_kind(found, SymmetryKind::rotation) == 3);
}

TEST_CASE("asymmetric solids have no symmetry") {
  for (const auto& [name, shape] : solids::asymmetric_zoo()) {
    CAPTURE(name);
    CHECK(find_symmetries(shape).empty());
  }
}

TEST_CASE("planes move along with the shape") {
  const Shape chair = solids::chair();
  const Shape crate = solids::box({2, 3, 4});
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    solids::Random random(seed);
    const Eigen::Matrix3d turn = solids::random_rotation(seed);
    const double scale = std::pow(10, random.uniform(-3, 3));
    const Eigen::Vector3d shift = 5 * scale * random.in_cube();
    const auto moved = [&](const Shape& shape) { return transformed(shape, scale * turn, shift); };
    const auto planes = find_symmetries(moved(chair));
    CHECK(planes.size() == 1);
    CHECK(has_plane(planes, shift, turn.col(0), 1e-7 * std::max(1.0, scale)));
    CHECK(planes.front().symmetry.axis.cross(turn.col(0)).norm() <= 1e-7);
    const auto box = find_symmetries(moved(crate));
    CHECK(count_of_kind(box, SymmetryKind::reflection) == 3);
    for (int k = 0; k < 3; ++k)
      CHECK(box[static_cast<std::size_t>(k)].symmetry.axis.cross(turn.col(2 - k)).norm() <= 1e-7);
  }
}

TEST_CASE("the order and number of triangles do not matter") {
  const Shape chair = solids::chair();
  for (const Shape& variant :
       {solids::permuted(chair, 7), solids::subdivided(chair), solids::flipped(chair)}) {
    const auto found = find_symmetries(variant);
    CHECK(found.size() == 1);
    CHECK(has_plane(found, {0, 0, 0}, {1, 0, 0}, 1e-9));
  }
}

TEST_CASE("the same bytes for any number of threads") {
  const Shape cup = solids::noisy(solids::cup_with_handle(), 0.002, 1);
  const auto run = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return find_symmetries(cup);
  };
  const auto one = run(1), four = run(4);
  REQUIRE(one.size() == four.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    CHECK(one[k].symmetry.axis == four[k].symmetry.axis);
    CHECK(one[k].symmetry.point == four[k].symmetry.point);
    CHECK(one[k].residual == four[k].residual);
  }
}

TEST_CASE("noise of one percent hides no symmetry") {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    CAPTURE(seed);
    const auto box = find_symmetries(solids::noisy(solids::finely(solids::box({2, 3, 4}), 2), 0.01, seed));
    CHECK(count_of_kind(box, SymmetryKind::reflection) == 3);
    for (int k = 0; k < 3; ++k) CHECK(has_plane(box, {1, 1.5, 2}, Eigen::Vector3d::Unit(k), 0.06));
    const auto prism =
        find_symmetries(solids::noisy(solids::finely(solids::cylinder(1, 1.5, 5), 1), 0.01, seed));
    CHECK(count_of_kind(prism, SymmetryKind::reflection) == 6);
    const auto chair = find_symmetries(solids::noisy(solids::finely(solids::chair(), 1), 0.01, seed));
    CHECK(chair.size() == 1);
    CHECK(has_plane(chair, {0, 0, 4}, {1, 0, 0}, 0.1));
  }
  const auto cup = find_symmetries(solids::noisy(solids::cup_with_handle(), 0.01, 1));
  CHECK(count_of_kind(cup, SymmetryKind::reflection) == 1);
  CHECK(has_plane(cup, {0, 0, 4}, {0, 1, 0}, 0.15));
}

TEST_CASE("a shape that cannot be analysed and options out of range are refused") {
  Shape nothing;
  CHECK_THROWS_AS(find_symmetries(nothing), InputError);
  Points points(3, 3);
  points << 0, 0, 0, 1, 1, 1, 2, 2, 2;
  Triangles triangles(1, 3);
  triangles << 0, 1, 2;
  CHECK_THROWS_AS(find_symmetries(make_shape(points, triangles)), InputError);
  Shape broken = solids::box({1, 1, 1});
  broken.vertices(0, 0) = std::nan("");
  CHECK_THROWS_AS(find_symmetries(broken), InputError);
  const Shape box = solids::box({1, 2, 3});
  CHECK_THROWS_AS(find_symmetries(box, {0, 0.9}), UsageError);
  CHECK_THROWS_AS(find_symmetries(box, {0.01, 1.5}), UsageError);
  CHECK_THROWS_AS(find_symmetries(box, {0.01, 0}), UsageError);
}
