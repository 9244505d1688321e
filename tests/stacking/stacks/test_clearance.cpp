#include <cmath>
#include <limits>
#include <numbers>

#include "stackabilization/core/errors.h"
#include "stackabilization/stacking/clearance.h"
#include "stackabilization/stacking/rigid_transform.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

/// Square bin with the given apothems, walls along x and y after the turn by 45 degrees.
Shape drafted_bin() {
  const double corner = std::numbers::sqrt2;
  const Shape bin = solids::frustum_shell(
      {3 * corner, 4 * corner, 2.5 * corner, 3.5 * corner, /*height=*/8, /*floor=*/0.5, /*segments=*/4});
  return transformed(bin, rotation_about({Eigen::Vector3d::Zero(), upwards}, 45));
}

/// Every piece of the Minkowski sum of every triangle with the polygon of corners at `radius`, none left out.
Shape every_piece(const Shape& shape, const Direction& direction, const DilationOptions& options) {
  const Frame frame = frame_of(direction);
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < options.corners; ++i) {
    const double angle = (2 * i + 1) * std::numbers::pi / options.corners;
    const double radius = options.play / std::cos(std::numbers::pi / options.corners);
    corners.push_back(radius * (std::cos(angle) * frame.u + std::sin(angle) * frame.v));
  }
  std::vector<Eigen::Vector3d> points;
  const auto add = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    points.insert(points.end(), {a, b, c});
  };
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector3d &s = corners[i], &next = corners[(i + 1) % corners.size()];
      const Eigen::Vector3d p[3] = {shape.corner(t, 0), shape.corner(t, 1), shape.corner(t, 2)};
      add(p[0] + s, p[1] + s, p[2] + s);
      for (int c = 0; c < 3; ++c) {
        const Eigen::Vector3d &a = p[c], &b = p[(c + 1) % 3];
        add(a + s, b + s, b + next);
        add(a + s, b + next, a + next);
        add(a, a + s, a + next);
      }
    }
  Points vertices(static_cast<Eigen::Index>(points.size()), 3);
  Triangles triangles(vertices.rows() / 3, 3);
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    vertices.row(v) = points[static_cast<std::size_t>(v)].transpose();
    triangles(v / 3, v % 3) = static_cast<std::int32_t>(v);
  }
  return make_shape(vertices, triangles);
}

double play_length(const Shape& below, const Shape& above, const Direction& direction,
                   const PlayOptions& options) {
  const Separation found = separation_with_play(below, above, direction, options);
  REQUIRE(found.blocked);
  return found.length;
}

}  // namespace

TEST_CASE("play does not change how boxes stack") {
  const Shape box = solids::box({1, 2, 3});
  for (const double play : {0.0, 0.1, 0.7, 5.0}) CHECK(play_length(box, box, upwards, {play}) == Approx(3));
}

TEST_CASE("a drafted wall gains play over tangent of the draft") {
  // Over the foot the gap is that between the inner wall at apothem 3 + p and the foot: slope 7.5 up to the
  // rim.
  const Shape bin = drafted_bin();
  for (const double play : {0.0, 0.01, 0.1, 0.25, 0.4})
    CHECK(play_length(bin, bin, upwards, {play}) == Approx(4.25 + 7.5 * play).epsilon(1e-12));
  CHECK(play_length(bin, bin, upwards, {0.6}) == Approx(8));
}

TEST_CASE("a posed bin gains the same") {
  const RigidTransform pose = rotation_about({{1, 2, 3}, Direction(1, -2, 0.5)}, 71);
  const Shape bin = transformed(drafted_bin(), pose);
  const Direction r(Eigen::Vector3d(3 * pose.rotation.col(2)));
  // Here the polygon is turned against the walls, so only the bounds of its overestimate are known.
  const double length = play_length(bin, bin, r, {0.25});
  CHECK(length >= 4.25 + 7.5 * 0.25 - 1e-9);
  CHECK(length <= 4.25 + 7.5 * 0.25 / std::cos(std::numbers::pi / 16) + 1e-9);
}

TEST_CASE("posts pass each other exactly as long as the play is smaller than their distance") {
  const Shape post = solids::box({0, 0, 0}, {1, 1, 5});
  const double most = 1 / std::cos(std::numbers::pi / 16);
  const Shape beside = solids::box({1.5, 0, 1}, {2.5, 1, 4});
  CHECK_FALSE(separation_with_play(post, beside, upwards, {0.49}).blocked);
  CHECK(play_length(post, beside, upwards, {0.51}) == Approx(4));
  const Shape diagonal = solids::box({1.5, 1.5, 1}, {2.5, 2.5, 4});
  CHECK_FALSE(separation_with_play(post, diagonal, upwards, {0.999 * std::sqrt(0.5) / most}).blocked);
  CHECK(play_length(post, diagonal, upwards, {1.001 * std::sqrt(0.5)}) == Approx(4));
}

TEST_CASE("leaving out pieces of the Minkowski sum changes nothing") {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Shape below =
        solids::triangle_soup({.seed = seed, .count = 12, .size = 0.6, .grid_bits = seed % 3 == 0 ? 2 : 0});
    const Shape above = seed % 4 == 1 ? solids::subdivided(solids::torus({1, 0.4, 8, 8})) : below;
    const Shape lower = seed % 4 == 2 ? solids::subdivided(solids::torus({1, 0.4, 8, 8})) : below;
    const Direction r = seed % 3 == 0 ? upwards : Direction(0.3, -0.2, seed % 2 == 0 ? 1 : -1);
    for (const ContactSemantics semantics : {ContactSemantics::solid, ContactSemantics::closed}) {
      const DilationOptions dilation{0.3, 8, DilatedSide::both};
      const Separation expected =
          separation(SeparationTree(every_piece(lower, r, dilation)), SeparationTree(above), r,
                     {.semantics = semantics, .abandon_above = std::nullopt});
      CAPTURE(seed);
      CHECK(play_length(lower, above, r, {0.3, 8, semantics}) == Approx(expected.length).epsilon(1e-9));
      const DilatedShape raised = dilate_laterally(above, r, {0.3, 8, DilatedSide::lower});
      const Separation other = separation(SeparationTree(lower), SeparationTree(raised.shape), r,
                                          {.semantics = semantics, .abandon_above = std::nullopt});
      CHECK(other.length == Approx(expected.length).epsilon(1e-9));
    }
  }
}

TEST_CASE("no shift within the play asks for more, and play is monotone") {
  solids::Random random(7);
  const Direction r(0.1, 0.4, 1);
  const Frame frame = frame_of(r);
  const Shape below = solids::triangle_soup({.seed = 21, .count = 60}),
              above = solids::triangle_soup({.seed = 22, .count = 60});
  double previous = separation(SeparationTree(below), SeparationTree(above), r).length;
  CHECK(play_length(below, above, r, {0}) == previous);
  for (const double play : {0.02, 0.1, 0.3}) {
    const double with_play = play_length(below, above, r, {play});
    CHECK(with_play >= previous);
    previous = with_play;
    double most = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < 200; ++i) {
      const double angle = random.uniform(0, 2 * std::numbers::pi),
                   radius = play * std::sqrt(random.uniform());
      const Eigen::Vector3d shift = radius * (std::cos(angle) * frame.u + std::sin(angle) * frame.v);
      const Shape shifted = solids::moved(above, shift);
      most = std::max(most, separation(SeparationTree(below), SeparationTree(shifted), r).length);
    }
    CHECK(most <= with_play + 1e-12);
    CHECK(most >= with_play - 0.3);
  }
}

TEST_CASE("a dilated shape keeps its parts, knows its sources and stays small") {
  Shape shape = concatenate(solids::sphere(1, 3), solids::box({2, 0, 0}, {3, 1, 1}));
  const DilatedShape dilated = dilate_laterally(shape, upwards, {0.1});
  CHECK_NOTHROW(validate(dilated.shape));
  CHECK(dilated.shape.part_names == shape.part_names);
  REQUIRE(dilated.source_triangle.size() == static_cast<std::size_t>(dilated.shape.triangle_count()));
  for (std::size_t t = 0; t < dilated.source_triangle.size(); ++t)
    CHECK(dilated.shape.triangle_part[t] ==
          shape.triangle_part[static_cast<std::size_t>(dilated.source_triangle[t])]);
  CHECK(dilated.shape.triangle_count() < 10 * shape.triangle_count());
  const Eigen::RowVector3d low = dilated.shape.vertices.colwise().minCoeff();
  CHECK(low.x() == Approx(-1.1));
  CHECK(low.z() == Approx(-1));
}

TEST_CASE("repeated vertices do not matter") {
  const Shape torus = solids::torus({});
  Shape loose = torus;
  loose.vertices.resize(3 * torus.triangle_count(), 3);
  for (Eigen::Index t = 0; t < torus.triangle_count(); ++t)
    for (int c = 0; c < 3; ++c) {
      loose.vertices.row(3 * t + c) = torus.corner(t, c).transpose();
      loose.triangles(t, c) = static_cast<std::int32_t>(3 * t + c);
    }
  CHECK(dilate_laterally(loose, upwards, {0.1}).shape.triangle_count() ==
        dilate_laterally(torus, upwards, {0.1}).shape.triangle_count());
}

TEST_CASE("the witness of a separation with play names the given triangles") {
  const Shape bin = drafted_bin();
  const Separation found = separation_with_play(bin, bin, upwards, {0.25});
  REQUIRE(found.blocked);
  CHECK(found.witness.upper_triangle < bin.triangle_count());
  CHECK(found.witness.lower_triangle < bin.triangle_count());
  CHECK((found.witness.upper_point - found.witness.lower_point).z() == Approx(found.length));
}

TEST_CASE("play out of range is refused") {
  const Shape box = solids::box({1, 2, 3});
  CHECK_THROWS_AS(dilate_laterally(box, upwards, {-0.1}), UsageError);
  CHECK_THROWS_AS(dilate_laterally(box, upwards, {std::numeric_limits<double>::quiet_NaN()}), UsageError);
  CHECK_THROWS_AS(dilate_laterally(box, upwards, {0.1, 7}), UsageError);
  CHECK_THROWS_AS(dilate_laterally(box, upwards, {0.1, 2}), UsageError);
  CHECK_THROWS_AS(dilate_laterally(box, upwards, {0.1, 1000}), UsageError);
  CHECK_THROWS_AS(separation_with_play(box, Shape{}, upwards, {0.1}), InputError);
}
