#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <vector>

#include "stackabilization/core/errors.h"
#include "stackabilization/stacking/collision.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/f_max.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

Rational ratio(const char* numerator, const char* denominator) {
  return {numerator, denominator};
}

Shape sheet(const std::vector<Eigen::Vector3d>& corners) {
  Points points(static_cast<Eigen::Index>(corners.size()), 3);
  for (std::size_t k = 0; k < corners.size(); ++k)
    points.row(static_cast<Eigen::Index>(k)) = corners[k].transpose();
  Triangles triangles(points.rows() / 3, 3);
  for (std::int32_t t = 0; t < triangles.rows(); ++t) triangles.row(t) << 3 * t, 3 * t + 1, 3 * t + 2;
  return make_shape(points, triangles);
}

}  // namespace

TEST_CASE("boxes touch and overlap exactly when their intervals do", "[collision]") {
  const Shape box = solids::box({2, 3, 4});
  for (const double x : {-2.0, -1.0, 0.0, 0.5, 2.0, 2.5})
    for (const double y : {-3.0, 0.0, 1.0, 3.0}) {
      const CollisionTester tester(box, solids::moved(box, {x, y, 0}));
      REQUIRE(tester.solids());
      for (const double z : {-5.0, -4.0, -1.0, 0.0, 3.0, 4.0}) {
        CAPTURE(x, y, z);
        CHECK(tester.closed_contact(upwards, Rational(z)) ==
              (std::abs(x) <= 2 && std::abs(y) <= 3 && std::abs(z) <= 4));
        CHECK(tester.interiors_overlap(upwards, Rational(z)) ==
              (std::abs(x) < 2 && std::abs(y) < 3 && std::abs(z) < 4));
      }
    }
}

TEST_CASE("lifts are exact: a third of an oblique direction is neither more nor less", "[collision]") {
  const Shape box = solids::box({1, 1, 1});
  const Direction oblique(3, 3, 3);
  const Rational third = ratio("1", "3");
  const Rational sliver = ratio("1", "1000000000000000000000000000000");
  CHECK(closed_contact(box, box, oblique, third));
  CHECK_FALSE(closed_contact(box, box, oblique, third + sliver));
  CHECK_FALSE(interiors_overlap(box, box, oblique, third));
  CHECK(interiors_overlap(box, box, oblique, third - sliver));
}

TEST_CASE("a solid inside another overlaps it without touching", "[collision]") {
  const Shape large = solids::box({9, 9, 9});
  const Shape small = solids::moved(solids::sphere(1, 1), {4, 4, 4});
  CHECK_FALSE(closed_contact(large, small, upwards, Rational(0)));
  CHECK(interiors_overlap(large, small, upwards, Rational(0)));
  CHECK(interiors_overlap(small, large, upwards, Rational(0)));
  CHECK_FALSE(interiors_overlap(large, small, upwards, Rational(20)));
}

TEST_CASE("a solid inside another overlaps it also where every ray along an axis meets an edge",
          "[collision]") {
  // Rays along x and z from the base of the tetrahedron, which lies at y = 5, leave through the edges there.
  // Rays along y from the points (271 + 13 k, 5, 389 - 17 k) of that base leave through the diagonals.
  Points around(12, 3);
  for (int level = 0; level < 3; ++level) {
    const double y = 100.0 * (level - 1) + 5;
    around.row(4 * level) << 271 - 13 * 200, y, 389 + 17 * 200;
    around.row(4 * level + 1) << 5000, y, 5000;
    around.row(4 * level + 2) << 271 + 13 * 200, y, 389 - 17 * 200;
    around.row(4 * level + 3) << -5000, y, -5000;
  }
  Triangles triangles(20, 3);
  triangles.topRows(4) << 0, 2, 1, 0, 3, 2, 8, 9, 10, 8, 10, 11;
  for (int level = 0; level < 2; ++level)
    for (int k = 0; k < 4; ++k) {
      const int a = 4 * level + k, b = 4 * level + (k + 1) % 4;
      triangles.middleRows(4 + 2 * a, 2) << a, b, b + 4, a, b + 4, a + 4;
    }
  const Shape prism = make_shape(around, triangles);
  Points corners(4, 3);
  corners << 0, 5, 0, 997, 5, 0, 0, 5, 997, 1, 6, 1;
  Triangles faces(4, 3);
  faces << 0, 1, 2, 1, 0, 3, 2, 1, 3, 0, 2, 3;
  const Shape tetrahedron = make_shape(corners, faces);
  REQUIRE(CollisionTester(prism, tetrahedron).solids());
  REQUIRE_FALSE(closed_contact(prism, tetrahedron, upwards, Rational(0)));
  CHECK(interiors_overlap(prism, tetrahedron, upwards, Rational(0)));
  CHECK(interiors_overlap(tetrahedron, prism, upwards, Rational(0)));
  CHECK_FALSE(interiors_overlap(prism, tetrahedron, upwards, Rational(20000)));
}

TEST_CASE("a peg in a hole of its own width slides without overlap", "[collision]") {
  const Shape u = solids::u_shape(3, 1);  // slot [1, 2] x [0, 1] x [1, 3]
  const Shape peg = solids::box({1, 0, 0}, {2, 1, 1});
  const CollisionTester tester(u, peg);
  CHECK(tester.closed_contact(upwards, Rational(1.5)));
  CHECK_FALSE(tester.interiors_overlap(upwards, Rational(1.5)));
  CHECK_FALSE(tester.interiors_overlap(upwards, Rational(1)));
  CHECK(tester.interiors_overlap(upwards, Rational(0.999)));
  CHECK(interiors_overlap(u, solids::moved(peg, {0.001, 0, 0}), upwards, Rational(1.5)));
}

TEST_CASE("edges that lie in a face tell a standing roof from a piercing one", "[collision]") {
  const Shape slab = solids::box({-9, -9, -1}, {9, 9, 0});
  // A square bar along y that stands on an edge, its diagonal upright.
  const Shape bar = solids::extruded_profile({{0, 0}, {1, 1}, {0, 2}, {-1, 1}}, 4);
  const CollisionTester tester(slab, bar);
  CHECK(tester.closed_contact(upwards, Rational(0)));
  CHECK_FALSE(tester.interiors_overlap(upwards, Rational(0)));
  CHECK(tester.interiors_overlap(upwards, Rational(-1)));  // two edges in the slab's top, faces on both sides
  CHECK(tester.interiors_overlap(upwards, Rational(-2)));
  CHECK(tester.closed_contact(upwards, Rational(-3)));
  CHECK_FALSE(tester.interiors_overlap(upwards, Rational(-3)));
}

TEST_CASE("a bar through a slab of the same width is found by its walls alone", "[collision]") {
  // All contacts are between coplanar faces and edges in faces.
  const Shape slab = solids::box({4, 2, 1});
  const Shape bar = solids::box({1, 0, -3}, {2, 2, 4});
  CHECK(interiors_overlap(slab, bar, upwards, Rational(0)));
  CHECK(interiors_overlap(bar, slab, upwards, Rational(0)));
  CHECK(interiors_overlap(slab, solids::moved(bar, {2, 0, 0}), upwards, Rational(0)));
  CHECK_FALSE(interiors_overlap(slab, solids::moved(bar, {3, 0, 0}), upwards, Rational(0)));
}

TEST_CASE("the order of triangles, a subdivision and the roles do not matter", "[collision]") {
  const Shape torus = solids::torus({});
  const Shape cup = solids::frustum_shell({});
  const Shape fine = solids::subdivided(cup), shuffled = solids::permuted(cup, 7);
  int overlaps = 0;
  for (const double lift : {-9.0, -1.0, 0.0, 0.75, 7.0, 8.5, 9.5}) {
    CAPTURE(lift);
    const bool touch = closed_contact(cup, torus, upwards, Rational(lift));
    const bool overlap = interiors_overlap(cup, torus, upwards, Rational(lift));
    overlaps += overlap;
    CHECK(closed_contact(fine, torus, upwards, Rational(lift)) == touch);
    CHECK(interiors_overlap(fine, torus, upwards, Rational(lift)) == overlap);
    CHECK(closed_contact(shuffled, torus, upwards, Rational(lift)) == touch);
    CHECK(interiors_overlap(shuffled, torus, upwards, Rational(lift)) == overlap);
    CHECK(closed_contact(torus, cup, upwards, Rational(-lift)) == touch);
    CHECK(interiors_overlap(torus, cup, upwards, Rational(-lift)) == overlap);
  }
  CHECK(overlaps > 2);
  CHECK(overlaps < 7);
}

TEST_CASE("exact f_max is where collisions end, in both semantics", "[collision]") {
  const std::vector<Shape> shapes = {solids::frustum_shell({}), solids::stair_plate({}),
                                     solids::l_shape(3, 1), solids::boxes_sharing_wall(), solids::torus({})};
  const std::vector<Direction> directions = {{0, 0, 1}, {1, 0, 1}, {0.3, -0.2, 1}};
  const Rational delta = ratio("1", "1000000000000");
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    const CollisionTester tester(shapes[s], shapes[s]);
    for (const Direction& direction : directions) {
      CAPTURE(s, direction.vector().transpose());
      const Rational solid = exact_f_max(shapes[s], direction, ContactSemantics::solid);
      CHECK_FALSE(tester.interiors_overlap(direction, solid));
      CHECK(tester.interiors_overlap(direction, solid - delta));
      const Rational closed = exact_f_max(shapes[s], direction, ContactSemantics::closed);
      CHECK(tester.closed_contact(direction, closed));
      CHECK_FALSE(tester.closed_contact(direction, closed + delta));
    }
  }
}

TEST_CASE("hooks and wine glasses are free below f_max, and the search from the top is not misled",
          "[collision]") {
  const Shape hook = solids::hook({}), glass = solids::wine_glass(16);
  const CollisionTester hooks(hook, hook), glasses(glass, glass);
  CHECK_FALSE(hooks.interiors_overlap(upwards, Rational(2)));
  CHECK(hooks.interiors_overlap(upwards, Rational(5.5)));
  CHECK_FALSE(glasses.closed_contact(upwards, Rational(9)));
  CHECK(glasses.interiors_overlap(upwards, Rational(12.5)));

  const auto hook_bracket = translation_by_bisection(hooks, upwards);
  REQUIRE(hook_bracket);
  CHECK(hook_bracket->colliding < 6);
  CHECK(hook_bracket->free >= 6);
  CHECK(hook_bracket->free == Approx(6).epsilon(1e-8));
  const auto glass_bracket = translation_by_bisection(glasses, upwards);
  REQUIRE(glass_bracket);
  CHECK(glass_bracket->colliding < 13);
  CHECK(glass_bracket->free == Approx(13).epsilon(1e-8));
}

TEST_CASE("the search from the top handles two shapes, lengths of r and a clear way", "[collision]") {
  const Shape box = solids::box({2, 2, 3});
  const Shape lid = solids::box({0, 0, 10}, {1, 1, 11});
  const auto bracket = translation_by_bisection(CollisionTester(box, lid), Direction(0, 0, 4));
  REQUIRE(bracket);
  CHECK(bracket->free == Approx(-7.0 / 4).epsilon(1e-8));
  CHECK(bracket->colliding < -7.0 / 4);
  CHECK_FALSE(translation_by_bisection(CollisionTester(box, solids::moved(lid, {5, 0, 0})), upwards));
}

TEST_CASE("open sheets can touch but have no interior", "[collision]") {
  const Shape floor = sheet({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
  const Shape needle = sheet({{1, 1, 1}, {1, 1, 5}, {1, 2, 5}});
  const CollisionTester tester(floor, needle);
  CHECK_FALSE(tester.solids());
  CHECK(tester.closed_contact(upwards, Rational(-1)));
  CHECK(tester.closed_contact(upwards, Rational(-5)));
  CHECK_FALSE(tester.closed_contact(upwards, Rational(-0.999)));
  CHECK_FALSE(tester.closed_contact(upwards, Rational(-5.001)));
  CHECK_THROWS_AS(tester.interiors_overlap(upwards, Rational(-2)), InputError);
  BisectionOptions options;
  options.semantics = ContactSemantics::closed;
  const auto bracket = translation_by_bisection(tester, upwards, options);
  REQUIRE(bracket);
  CHECK(bracket->free == Approx(-1).epsilon(1e-8));
}

TEST_CASE("triangles without area neither touch nor open a solid", "[collision]") {
  Shape box = solids::box({1, 1, 1});
  box.triangles.conservativeResize(13, 3);
  box.triangles.row(12) << 0, 0, 1;
  box.triangle_part.push_back(0);
  const CollisionTester tester(box, box);
  CHECK(tester.solids());
  CHECK(tester.interiors_overlap(upwards, Rational(0.5)));
  CHECK_FALSE(tester.interiors_overlap(upwards, Rational(1)));
  const Shape line = sheet({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}});
  CHECK_FALSE(closed_contact(line, box, upwards, Rational(0)));
  CHECK_FALSE(closed_contact(box, line, upwards, Rational(0)));
}

TEST_CASE("solids are recognised without shared indices and with touching parts", "[collision]") {
  const Shape box = solids::box({1, 1, 1});
  std::vector<Eigen::Vector3d> corners;
  for (Eigen::Index t = 0; t < box.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) corners.push_back(box.corner(t, k));
  const Shape loose = sheet(corners);
  CHECK(CollisionTester(loose, box).solids());
  CHECK(interiors_overlap(loose, box, upwards, Rational(0.5)));
  // Two boxes along one edge: four triangles meet there, two of each part.
  CHECK(CollisionTester(concatenate(loose, solids::moved(loose, {1, 1, 0})), box).solids());
  corners.resize(corners.size() - 3);
  CHECK_FALSE(CollisionTester(sheet(corners), box).solids());
}

TEST_CASE("parts in one place are as one", "[collision]") {
  const Shape box = solids::box({2, 3, 4}), other = solids::box({1, 1, 1});
  Shape many = box;
  for (int k = 1; k < 1000; ++k) many = concatenate(many, box);
  const CollisionTester one_against(box, other), many_against(many, other), themselves(many, many);
  CHECK(themselves.interior_defect() == std::nullopt);
  for (const double z : {-1.0, -0.5, 0.0, 3.5, 4.0, 4.5}) {
    CHECK(many_against.closed_contact(upwards, Rational(z)) ==
          one_against.closed_contact(upwards, Rational(z)));
    CHECK(many_against.interiors_overlap(upwards, Rational(z)) ==
          one_against.interiors_overlap(upwards, Rational(z)));
    CHECK(themselves.closed_contact(upwards, Rational(z)) == (z <= 4));
    CHECK(themselves.interiors_overlap(upwards, Rational(z)) == (z < 4));
  }
  // A wedge that shares faces with the box, but not all of their neighbours.
  Shape wedge = box;
  for (Eigen::Index v = 0; v < wedge.vertex_count(); ++v)
    if (wedge.vertices(v, 2) == 4) wedge.vertices(v, 0) = 0;
  const Shape both = concatenate(wedge, box), bar = solids::moved(solids::box({1, 1, 1}), {1, 1, 0});
  CHECK_FALSE(interiors_overlap(wedge, bar, upwards, Rational(3)));
  CHECK(interiors_overlap(both, bar, upwards, Rational(3)));
  CHECK(interiors_overlap(concatenate(box, wedge), bar, upwards, Rational(3)));
}

TEST_CASE("more pairs of near triangles than can be tested are refused, however they are met",
          "[collision]") {
  const Eigen::Matrix3d aslant = Eigen::AngleAxisd(0.5, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  const Shape box = transformed(solids::box({2, 3, 4}), aslant, Eigen::Vector3d::Zero());
  Shape nearly_one = box;
  for (int k = 1; k < 800; ++k)
    nearly_one = concatenate(nearly_one, solids::moved(box, {1e-9 * k, 2e-9 * k, 1e-9 * k}));
  const CollisionTester tester(nearly_one, nearly_one);
  CHECK_THROWS_AS(tester.closed_contact(upwards, Rational(0)), InputError);
  CHECK_THROWS_AS(tester.interiors_overlap(upwards, Rational(0)), InputError);
  CHECK_FALSE(tester.closed_contact(upwards, Rational(10)));
  CHECK(tester.interior_defect() == InteriorDefect::undecided);
}

TEST_CASE("impossible searches and shapes are refused", "[collision]") {
  const Shape box = solids::box({1, 1, 1});
  const CollisionTester tester(box, box);
  CHECK_THROWS_AS(CollisionTester(box, Shape{}), InputError);
  BisectionOptions no_steps, no_width, not_a_width;
  no_steps.steps = 0;
  no_width.relative_width = 0;
  not_a_width.relative_width = std::nan("");
  CHECK_THROWS_AS(translation_by_bisection(tester, upwards, no_steps), UsageError);
  CHECK_THROWS_AS(translation_by_bisection(tester, upwards, no_width), UsageError);
  CHECK_THROWS_AS(translation_by_bisection(tester, upwards, not_a_width), UsageError);
}
