#include <vector>

#include "stackabilization/core/errors.h"
#include "stackabilization/envelope/separation.h"
#include "stackabilization/stacking/minkowski.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/f_max.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

Shape rod(double x, double z) {
  return solids::box({x, 0, z}, {x + 1, 1, z + 1});
}

std::vector<solids::NamedShape> small_solids() {
  const Shape box = solids::box({1, 2, 3});
  return {{"box", box},
          {"turned box", transformed(box, solids::random_rotation(3), {0.1, 0.2, 0.3})},
          {"tetrahedron", solids::tetrahedron({{{0, 0, 0}, {2, 0, 0.5}, {0.25, 3, 0}, {0.5, 0.75, 2}}})},
          {"L", solids::l_shape(3, 1)},
          {"U", solids::u_shape(3, 1)},
          {"stairs", solids::stairs({3, 1, 0.75, 2, 0.25})},
          {"stair plate", solids::stair_plate({3, 1, 0.75, 2, 0.25})},
          {"wedge", solids::extruded_profile({{0, 0}, {3, 0}, {0, 0.7}}, 1.5)},
          {"hook", solids::hook({})},
          {"octahedron", solids::sphere(1, 0)},
          {"triangular prism", solids::prism({{0, 0}, {2, 0.25}, {0.5, 1.75}}, 1.25)},
          {"arrow prism", solids::prism({{0, 0}, {2, 1}, {0, 2}, {0.5, 1}}, 0.75)},
          {"zig-zag", solids::extruded_profile({{0, 0}, {1, 1}, {0, 2}, {0, 1.5}, {0.5, 1}, {0, 0.5}}, 1)},
          {"two rods", concatenate(rod(0, 0), rod(0.5, 2))},
          {"roof", solids::extruded_profile({{0, 0}, {2, 2}, {4, 0}, {4, 0.5}, {2, 2.5}, {0, 0.5}}, 1)}};
}

}  // namespace

TEST_CASE("the Minkowski sum gives the exact separation, as one rational number", "[minkowski]") {
  const std::vector<Direction> directions = {{0, 0, 1}, {1, 0, 0}, {0.3, -0.2, 1}, {-1, 2, 0.5}};
  for (const solids::NamedShape& solid : small_solids())
    for (const Direction& direction : directions) {
      CAPTURE(solid.name, direction.vector().transpose());
      const Rational sum = minkowski_translation(solid.shape, direction);
      const Rational exact = exact_f_max(solid.shape, direction);
      CAPTURE(sum.numerator(), sum.denominator(), exact.numerator(), exact.denominator());
      CHECK(sum == exact);
    }
}

TEST_CASE("Minkowski sums of boxes, tetrahedra and stairs have closed forms", "[minkowski]") {
  CHECK(minkowski_translation(solids::box({1, 2, 3}), upwards) == Rational(3));
  CHECK(minkowski_translation(solids::box({1, 2, 3}), Direction(0, 0, -4)) == Rational(0.75));
  CHECK(minkowski_translation(solids::box({1, 2, 3}), Direction(3, 3, 3)) == Rational("1", "3"));
  CHECK(minkowski_translation(solids::stair_plate({3, 1, 0.75, 2, 0.25}), upwards) == Rational(1));
  CHECK(minkowski_translation(solids::l_shape(3, 1), Direction(1, 0, 1)) == Rational(1));
}

TEST_CASE("a passage that the solid just fits into stays open", "[minkowski]") {
  CHECK(minkowski_translation(solids::boxes_sharing_wall(), upwards) == Rational(1));
  // A peg below, a socket of its width above: peg and socket walls slide along each other from lift 4.5 down
  // to 2.5.
  const Shape plug = solids::extruded_profile({{0, 0.25},
                                               {1, 0.25},
                                               {1, -2},
                                               {2, -2},
                                               {2, 0.25},
                                               {3, 0.25},
                                               {3, 2.5},
                                               {2, 2.5},
                                               {2, 0.5},
                                               {1, 0.5},
                                               {1, 2.5},
                                               {0, 2.5}},
                                              1);
  CHECK(minkowski_translation(plug, upwards) == Rational(2.5));
  CHECK(exact_f_max(plug, upwards) == Rational(2.5));
}

TEST_CASE("hooks are blocked from above although they are free below", "[minkowski]") {
  CHECK(minkowski_translation(solids::hook({}), upwards) == Rational(6));
}

TEST_CASE("orientation, subdivision and order do not change a Minkowski sum", "[minkowski]") {
  const Shape wedge = solids::extruded_profile({{0, 0}, {3, 0}, {0, 0.7}}, 1.5);
  const Direction direction(0.3, 0.1, 1);
  const Rational value = minkowski_translation(wedge, direction);
  CHECK(minkowski_translation(solids::flipped(wedge), direction) == value);
  CHECK(minkowski_translation(solids::permuted(wedge, 5), direction) == value);
  CHECK(minkowski_translation(solids::subdivided(wedge), direction) == value);
  CHECK(minkowski_translation(wedge, Direction(-0.3, -0.1, -1)) == value);
}

TEST_CASE("what has no Minkowski sum here is refused", "[minkowski]") {
  CHECK_THROWS_AS(minkowski_translation(solids::torus({}), upwards), UsageError);
  CHECK_THROWS_AS(minkowski_translation(Shape{}, upwards), InputError);
  Shape open = solids::box({1, 1, 1});
  open.triangles.conservativeResize(11, 3);
  open.triangle_part.resize(11);
  CHECK_THROWS_AS(minkowski_translation(open, upwards), InputError);
  Shape flat = solids::box({1, 1, 1});
  flat.vertices.col(2).setZero();
  CHECK_THROWS_AS(minkowski_translation(flat, upwards), InputError);
  // A bow tie prism crosses itself.
  const Shape square = solids::prism({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 1);
  Shape crossed = square;
  for (Eigen::Index v = 0; v < crossed.vertex_count(); ++v)
    if (square.vertices(v, 1) == 1) crossed.vertices(v, 0) = 1 - square.vertices(v, 0);
  CHECK_THROWS_AS(minkowski_translation(crossed, upwards), InputError);
}
