#include <cmath>

#include "stackabilization/core/errors.h"
#include "stackabilization/envelope/separation.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/f_max.h"
#include "support/rational_oracle.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;
using namespace stackabilization::solids;

namespace {

/// Large triangles through each other; on a coarse grid, so that edges meet corners and planes coincide, if
/// `bits` > 0.
Shape random_soup(int count, std::uint64_t seed, int bits = 0) {
  Soup soup;
  soup.count = count;
  soup.seed = seed;
  soup.size = 1;
  soup.grid_bits = bits;
  return triangle_soup(soup);
}

Rational sep(const Shape& below, const Shape& above, const Direction& direction) {
  const Separation result = separation(SeparationTree(below), SeparationTree(above), direction);
  REQUIRE(result.blocked);
  return result.value;
}

Shape scaled(const Shape& shape, double factor) {
  return transformed(shape, factor * Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero());
}

/// A sheet that is upright everywhere, whose projected triangles have areas that are zero but for rounding.
Shape oval_tube(int rings, int segments) {
  Points points((rings + 1) * segments, 3);
  Triangles triangles(2 * rings * segments, 3);
  for (int ring = 0; ring <= rings; ++ring)
    for (int k = 0; k < segments; ++k)
      points.row(ring * segments + k) << std::cos(6.2832 * k / segments),
          0.7 * std::sin(6.2832 * k / segments), ring;
  for (int row = 0, ring = 0; ring < rings; ++ring)
    for (int k = 0; k < segments; ++k) {
      const int a = ring * segments + k, b = ring * segments + (k + 1) % segments;
      triangles.row(row++) << a, b, b + segments;
      triangles.row(row++) << a, b + segments, a + segments;
    }
  return make_shape(points, triangles);
}

const std::vector<Direction>& plain_directions() {
  static const std::vector<Direction> list = {{0, 0, 1},      {0, 0, -2}, {1, 0, 0},    {0, -3, 0}, {1, 1, 0},
                                              {0.3, -0.2, 1}, {1, 2, 3},  {-1, 0.1, 0}, {2, -1, -2}};
  return list;
}

std::vector<Shape> solids_and_soups() {
  return {box({1, 2, 3}),
          boxes_sharing_wall(),
          l_shape(4, 1),
          u_shape(4, 1),
          hook({}),
          stairs({}),
          stair_plate({}),
          solids::table({}),
          frustum_shell({3, 4, 2.5, 3.5, 8, 0.5, 8}),
          random_soup(12, 7),
          random_soup(12, 8, 1),
          random_soup(16, 9, 2)};
}

}  // namespace

TEST_CASE("f_max of analytic solids is the closed form, exactly") {
  CHECK(exact_f_max(box({1, 2, 3}), upwards) == Rational(3.0));
  CHECK(exact_f_max(boxes_sharing_wall(), upwards) == Rational(1.0));
  CHECK(exact_f_max(hook({}), upwards) == Rational(6.0));
  CHECK(exact_f_max(stair_plate({}), upwards) == Rational(stair_plate_f_max({})));
  CHECK(exact_f_max(l_shape(4, 1), Direction(1, 0, 1)) == Rational(1.0));
  CHECK(exact_f_max(solids::table({}), upwards) == Rational(6.0));
  CHECK(exact_f_max(torus({}), upwards) == Rational(2.0));
  CHECK(exact_f_max(torus({}), Direction(1, 0, 0)) == Rational(8.0));
  CHECK(exact_f_max(gridfinity_bin({}), upwards) == Rational(21.0));
  CHECK(exact_f_max(frustum_shell({}), upwards).to_double() ==
        Approx(frustum_shell_f_max({})).epsilon(1e-14));
  for (const Direction& r : plain_directions())
    CHECK(exact_f_max(box({1, 2, 3}), r).to_double() == Approx(box_f_max({1, 2, 3}, r)).epsilon(1e-14));
}

TEST_CASE("walls in one plane block in closed semantics only") {
  CHECK(exact_f_max(boxes_sharing_wall(), upwards, ContactSemantics::solid) == Rational(1.0));
  CHECK(exact_f_max(boxes_sharing_wall(), upwards, ContactSemantics::closed) == Rational(3.0));
  CHECK(exact_f_max(boxes_sharing_wall(), Direction(0, 0, -1), ContactSemantics::closed) == Rational(3.0));
}

TEST_CASE("every answer equals pairwise clipping in rational arithmetic") {
  for (const Shape& shape : solids_and_soups())
    for (const Direction& r : plain_directions()) {
      const std::optional<Rational> expected = oracle_separation(shape, shape, r);
      const Separation result = minimal_stacking_translation(shape, r);
      REQUIRE(result.blocked == expected.has_value());
      if (expected) CHECK(result.value == *expected);
    }
}

TEST_CASE("random soups equal the oracle, also against each other") {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const int bits = static_cast<int>(seed % 3);
    const Shape a = random_soup(10, seed, bits),
                b = moved(random_soup(9, seed + 100, bits), {0.25, -0.5, 0.125});
    const Direction r = seed % 2 == 0 ? Direction(0, 0, 1)
                                      : Direction(0.1 * static_cast<double>(seed) - 0.6,
                                                  0.7 - 0.15 * static_cast<double>(seed), 1);
    const std::optional<Rational> expected = oracle_separation(a, b, r);
    const Separation result = separation(SeparationTree(a), SeparationTree(b), r);
    REQUIRE(result.blocked == expected.has_value());
    if (expected) CHECK(result.value == *expected);
  }
}

TEST_CASE("near-vertical slivers do not invent heights") {
  // The projected triangle is thinner than rounding; its plane extrapolates to 1e9 within the unit square.
  Points vertices(6, 3);
  vertices << 0, 0, 0, 1, 0, 0, 0.5, std::ldexp(1.0, -70), 1, 0, -1, 0.5, 1, -1, 0.5, 0.5, 1, 0.5;
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 3, 4, 5;
  const Shape shape = make_shape(vertices, triangles);
  for (const Direction& r : {Direction(0, 0, 1), Direction(1e-9, 0, 1), Direction(0, 1e-20, 1)}) {
    const Separation result = minimal_stacking_translation(shape, r);
    REQUIRE(result.blocked);
    CHECK(result.value == *oracle_separation(shape, shape, r));
    CHECK(result.length <= 1.5);
  }
}

TEST_CASE("the witness reproduces the value") {
  for (const Shape& shape : solids_and_soups())
    for (const Direction& r : plain_directions()) {
      const Separation result = minimal_stacking_translation(shape, r);
      if (!result.blocked) continue;
      const Witness& w = result.witness;
      CHECK(result.value == *oracle_pair(shape, w.upper_triangle, shape, w.lower_triangle, r));
      const Eigen::Vector3d lifted = w.lower_point + result.value.to_double() * r.vector();
      CHECK((lifted - w.upper_point).norm() < 1e-13 * (1 + w.upper_point.norm()));
      CHECK(result.length == Approx(result.value.to_double() * r.length()).epsilon(1e-15));
    }
}

TEST_CASE("f_max does not depend on how the surface is written down") {
  for (const Shape& shape : {l_shape(4, 1), hook({}), stairs({}), random_soup(20, 3)})
    for (const Direction& r : plain_directions()) {
      const Separation reference = minimal_stacking_translation(shape, r);
      if (!reference.blocked) continue;
      CHECK(exact_f_max(permuted(shape, 5), r) == reference.value);
      CHECK(exact_f_max(flipped(shape), r) == reference.value);
      CHECK(exact_f_max(shape, Direction(-r.vector())) == reference.value);
      CHECK(exact_f_max(shape, Direction(2 * r.vector())) * Rational(2.0) == reference.value);
      CHECK(exact_f_max(concatenate(shape, shape), r) == reference.value);
    }
}

TEST_CASE("exact motions, scalings and subdivisions keep the exact value") {
  for (const Shape& shape : {l_shape(4, 1), hook({}), solids::table({})})
    for (const Direction& r : plain_directions()) {
      const Rational reference = exact_f_max(shape, r);
      CHECK(exact_f_max(moved(shape, {16, -8, 0.5}), r) == reference);
      CHECK(exact_f_max(transformed(shape, 4 * Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()), r) ==
            reference * Rational(4.0));
      CHECK(exact_f_max(subdivided(subdivided(shape)), r) == reference);
    }
}

TEST_CASE("a union stacks no better than its parts") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Shape a = random_soup(15, seed), b = random_soup(15, seed + 50);
    for (const Direction& r : plain_directions()) {
      const Rational joined = exact_f_max(concatenate(a, b), r);
      CHECK(joined >= exact_f_max(a, r));
      CHECK(joined >= exact_f_max(b, r));
    }
  }
}

TEST_CASE("separations of two boxes are differences of their coordinates") {
  const Shape floor = box({-1, -1, 0}, {1, 1, 2}), cube = box({0.5, 0.5, 5}, {1.5, 1.5, 6});
  CHECK(sep(floor, cube, upwards) == Rational(-3.0));
  CHECK(sep(cube, floor, upwards) == Rational(6.0));
  CHECK(sep(floor, cube, Direction(0, 0, 4)) == Rational(-0.75));
}

TEST_CASE("shapes that pass each other are not blocked") {
  const Shape a = box({1, 1, 1}), apart = box({3, 0, 0}, {4, 1, 1}), touching = box({1, 0, 0}, {2, 1, 1});
  CHECK_FALSE(separation(SeparationTree(a), SeparationTree(apart), upwards).blocked);
  CHECK_FALSE(separation(SeparationTree(a), SeparationTree(touching), upwards).blocked);
  CHECK(separation(SeparationTree(a), SeparationTree(touching), upwards, {ContactSemantics::closed, {}})
            .blocked);
  CHECK_FALSE(
      separation(SeparationTree(a), SeparationTree(apart), upwards, {ContactSemantics::closed, {}}).blocked);
}

TEST_CASE("a sheet parallel to r has no area to collide with") {
  Points vertices(3, 3);
  vertices << 0, 0, 0, 1, 0, 0, 0, 0, 1;
  Triangles triangles(1, 3);
  triangles << 0, 1, 2;
  const Shape wall = make_shape(vertices, triangles);
  CHECK_FALSE(minimal_stacking_translation(wall, upwards).blocked);
  CHECK(exact_f_max(wall, upwards, ContactSemantics::closed) == Rational(1.0));
  CHECK(exact_f_max(wall, Direction(0, 1, 0)) == Rational(0.0));
}

TEST_CASE("neighbours in a sheet need no rational arithmetic") {
  const Shape sheet = bumpy_bowl(40);
  const SeparationTree tree(sheet);
  for (const Direction& r : {Direction(0, 0, 1), Direction(0.3, -0.2, 1)})
    for (const ContactSemantics semantics : {ContactSemantics::solid, ContactSemantics::closed}) {
      const Separation found = separation(tree, tree, r, {semantics, {}});
      CHECK(found.blocked);
      CHECK(found.value == Rational(0.0));
      CHECK(found.work.exact_pairs < 10);
      CHECK(found.work.triangle_pairs < 40 * sheet.triangle_count());
    }
}

TEST_CASE("each triangle of a wall along r is found edge-on once, not with each neighbour") {
  const SeparationTree tree(oval_tube(3, 50));
  const Separation found = separation(tree, tree, upwards);
  CHECK_FALSE(found.blocked);
  CHECK(found.work.exact_pairs == 0);
}

TEST_CASE("walls along r are left out of the search once many of them were met in vain") {
  const Shape tube = oval_tube(20, 50), half = oval_tube(10, 50);
  const SeparationTree tree(tube), other(half);
  for (const SeparationTree* above : {&tree, &other}) {
    const Separation found = separation(tree, *above, upwards);
    CHECK_FALSE(found.blocked);
    CHECK(found.work.triangle_pairs < 8 * tube.triangle_count());  // a column has 80 pairs per triangle
  }

  // Two flat triangles beside the tube, one above the other by a half: all that counts.
  Shape with_plates = tube;
  const auto corners = static_cast<int>(tube.vertex_count()), faces = static_cast<int>(tube.triangle_count());
  with_plates.vertices.conservativeResize(corners + 6, 3);
  with_plates.triangles.conservativeResize(faces + 2, 3);
  with_plates.vertices.bottomRows(6) << 5, 0, 0, 6, 0, 0, 5, 1, 0, 5, 0, 0.5, 6, 0, 0.5, 5, 1, 0.5;
  with_plates.triangles.bottomRows(2) << corners, corners + 1, corners + 2, corners + 3, corners + 4,
      corners + 5;
  CHECK(exact_f_max(make_shape(with_plates.vertices, with_plates.triangles), upwards,
                    ContactSemantics::solid) == Rational(0.5));
}

TEST_CASE("points and segments block in closed semantics") {
  Points vertices(6, 3);
  vertices << 0, 0, 3, 0, 0, 3, 0, 0, 3, -1, -1, 0, 2, -1, 0, -1, 2, 0;
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 3, 4, 5;
  const Shape shape = make_shape(vertices, triangles);
  CHECK(exact_f_max(shape, upwards, ContactSemantics::closed) == Rational(3.0));
  CHECK(exact_f_max(shape, upwards, ContactSemantics::solid) == Rational(0.0));
}

TEST_CASE("the enclosure holds the exact value and is narrow") {
  for (const Shape& shape : solids_and_soups()) {
    const SeparationTree tree(shape);
    for (const Direction& r : plain_directions()) {
      const Separation exact = separation(tree, tree, r);
      const Enclosure bounds = separation_enclosure(tree, tree, r);
      if (!exact.blocked) {
        CHECK(bounds.upper == -std::numeric_limits<double>::infinity());
        continue;
      }
      CHECK(Rational(bounds.lower) <= exact.value);
      CHECK(Rational(bounds.upper) >= exact.value);
      CHECK((bounds.upper - bounds.lower) * r.length() < 1e-10);
    }
  }
}

TEST_CASE("abandoning tells only that the answer is larger") {
  const SeparationTree tree(box({1, 2, 3}));
  SeparationOptions options;
  options.abandon_above = 2.0;
  const Enclosure early = separation_enclosure(tree, tree, upwards, options);
  CHECK(early.abandoned);
  CHECK(early.lower > 2.0);
  CHECK(early.lower <= 3.0);
  options.abandon_above = 3.5;
  CHECK_FALSE(separation_enclosure(tree, tree, upwards, options).abandoned);
}

TEST_CASE("huge and tiny shapes are measured alike") {
  const Shape shape = l_shape(4, 1);
  const Direction r(0.3, -0.2, 1);
  const Rational reference = exact_f_max(shape, r);
  for (const int exponent : {-190, -100, 100, 190}) {
    const double scale = std::ldexp(1.0, exponent);
    CHECK(exact_f_max(scaled(shape, scale), r) == reference * Rational(scale));
  }
  for (const int exponent : {-1000, -350, -260, -210, 200, 260, 350, 1000})
    CHECK_THROWS_AS(SeparationTree(scaled(shape, std::ldexp(1.0, exponent))), InputError);
}

TEST_CASE("details far below the size of a shape count") {
  // Products of their coordinates underflow.
  const Shape detail = concatenate(box({0, 0, 0}, {1, 1, 0.5}), box({0.25, 0.25, 4}, {0.75, 0.75, 5}));
  const Eigen::Vector3d shrink(std::ldexp(1.0, -540), std::ldexp(1.0, -540), 1);
  const Shape shape = concatenate(transformed(detail, shrink.asDiagonal(), Eigen::Vector3d::Zero()),
                                  box({1, 1, 0}, {2, 2, 1}));
  CHECK(exact_f_max(shape, upwards) == Rational(5.0));
}

TEST_CASE("a direction is slanted however little") {
  // The wall x = 0 leans over the floor by less than its corners' coordinates resolve.
  Points vertices(7, 3);
  vertices << 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, -1, 0, 0, 1, 0, 0, 0, 1, 0;
  Triangles triangles(3, 3);
  triangles << 0, 1, 3, 0, 3, 2, 4, 5, 6;
  const Shape shape = make_shape(vertices, triangles);
  CHECK(exact_f_max(shape, Direction(0, 0, 3)) == Rational(0.0));
  for (const double slant : {1e-3, 1e-17, 1e-300, 5e-324}) {
    const Direction r(slant, 0, 3);
    CHECK(exact_f_max(shape, r) == *oracle_separation(shape, shape, r));
    CHECK(exact_f_max(shape, r) > Rational(0.1));
  }
}

TEST_CASE("the distance from the origin does not matter") {
  const Direction r(0.3, -0.2, 1);
  for (const double distance : {1e3, 1048576.0, -1e7})
    for (const Shape& shape : {l_shape(4, 1), hook({}), random_soup(16, 9, 2)}) {
      const Eigen::Vector3d offset(distance, 2 * distance, -distance);
      const Shape far = moved(shape, offset);
      const SeparationTree tree(shape), far_tree(far);
      const Separation here = separation(tree, tree, r), there = separation(far_tree, far_tree, r);
      REQUIRE(there.blocked);
      CHECK(there.value == here.value);
      const Witness& w = there.witness;
      CHECK(there.value == *oracle_pair(far, w.upper_triangle, far, w.lower_triangle, r));
      const Eigen::Vector3d lifted = w.lower_point + there.value.to_double() * r.vector();
      CHECK((lifted - w.upper_point).norm() < 1e-15 * std::abs(distance));
      CHECK((w.upper_point - offset).norm() < 20);
      const Enclosure bounds = separation_enclosure(far_tree, far_tree, r);
      CHECK(Rational(bounds.lower) <= here.value);
      CHECK(Rational(bounds.upper) >= here.value);
      CHECK(bounds.upper - bounds.lower < 1e-11);
      // The gap between a shape and its far copy is that of the shape, less the shift along r.
      const Direction along(offset);
      CHECK(separation(tree, far_tree, along).value == exact_f_max(shape, along) - Rational(1.0));
    }
}

TEST_CASE("a tree refuses a shape without triangles") {
  CHECK_THROWS_AS(SeparationTree(Shape{}), InputError);
}
