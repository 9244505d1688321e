#include <algorithm>
#include <limits>

#include "stackabilization/core/errors.h"
#include "stackabilization/stacking/collision_probes.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/solids.h"

using namespace stackabilization;

namespace {

Separation f_max_of(const Shape& shape, const Direction& direction, ContactSemantics semantics) {
  const SeparationTree tree(shape);
  SeparationOptions options;
  options.semantics = semantics;
  return separation(tree, tree, direction, options);
}

std::vector<CollisionProbe> probes_of(const Shape& shape, const Direction& direction,
                                      ContactSemantics semantics) {
  return collision_probes(shape, direction, f_max_of(shape, direction, semantics), {semantics});
}

/// Number of probes whose outcome is not the one that follows from f_max.
int surprises(const Shape& shape, const Direction& direction, const std::vector<CollisionProbe>& probes) {
  const CollisionTester tester(shape, shape);
  return static_cast<int>(std::count_if(probes.begin(), probes.end(), [&](const CollisionProbe& probe) {
    return collides(tester, direction, probe) != probe.collides;
  }));
}

Shape one_triangle(const Eigen::Matrix3d& rows) {
  Triangles triangle(1, 3);
  triangle << 0, 1, 2;
  return make_shape(Points(rows), triangle);
}

}  // namespace

TEST_CASE("a box is probed above, at and below its height", "[collision_probes]") {
  // Dyadic numbers, so that all lifts are exact.
  const Shape box = solids::box({3, 5, 0.5});
  const Direction direction(0, 0, 4);
  const double margin = 0x1p-20;
  const Rational f_max(0.125), apart(margin * 0.5 / 4);
  const auto probes = [&](ContactSemantics semantics) {
    return collision_probes(box, direction, f_max_of(box, direction, semantics), {semantics, margin});
  };
  const std::vector<CollisionProbe> solid = probes(ContactSemantics::solid);
  REQUIRE(solid.size() == 3);
  CHECK((solid[0].place == ProbePlace::above && solid[0].lift == f_max + apart && !solid[0].collides));
  CHECK((solid[1].place == ProbePlace::at && solid[1].lift == f_max && !solid[1].collides));
  CHECK((solid[2].place == ProbePlace::below && solid[2].lift == f_max - apart && solid[2].collides));
  const std::vector<CollisionProbe> closed = probes(ContactSemantics::closed);
  REQUIRE(closed.size() == 2);
  CHECK((closed[0].place == ProbePlace::above && closed[0].lift == f_max + apart && !closed[0].collides));
  CHECK((closed[1].place == ProbePlace::at && closed[1].lift == f_max && closed[1].collides));
}

TEST_CASE("collision tests find what an exact f_max implies, and contradict any other",
          "[collision_probes]") {
  const std::vector<Shape> shapes = {solids::frustum_shell({}), solids::stair_plate({}),
                                     solids::l_shape(3, 1), solids::boxes_sharing_wall(), solids::hook({})};
  for (std::size_t s = 0; s < shapes.size(); ++s)
    for (const Direction& direction : {Direction(0, 0, 1), Direction(1, 0, 1), Direction(0.3, -0.2, 0.01)})
      for (const ContactSemantics semantics : {ContactSemantics::solid, ContactSemantics::closed}) {
        CAPTURE(s, direction.vector().transpose(), semantics == ContactSemantics::solid);
        const Separation exact = f_max_of(shapes[s], direction, semantics);
        const std::vector<CollisionProbe> probes = collision_probes(shapes[s], direction, exact, {semantics});
        CHECK(surprises(shapes[s], direction, probes) == 0);
        const Rational further = (probes.front().lift - exact.value) * Rational(2);
        for (const Rational& wrong : {exact.value + further, exact.value - further}) {
          Separation other = exact;
          other.value = wrong;
          CHECK(surprises(shapes[s], direction, collision_probes(shapes[s], direction, other, {semantics})) >
                0);
        }
      }
}

TEST_CASE("a shape without height is probed at a distance that follows from its width",
          "[collision_probes]") {
  const Shape sheet = one_triangle((Eigen::Matrix3d() << 0, 0, 1, 8, 0, 1, 0, 2, 1).finished());
  const std::vector<CollisionProbe> probes = probes_of(sheet, upwards, ContactSemantics::closed);
  REQUIRE(probes.size() == 2);
  CHECK(probes[0].lift == Rational(tolerance::collision_margin * 8));
  CHECK(probes[1].lift == Rational(0));
  CHECK(surprises(sheet, upwards, probes) == 0);
}

TEST_CASE("contact is not demanded where a triangle without area attains f_max", "[collision_probes]") {
  const Shape needle = one_triangle((Eigen::Matrix3d() << 0.5, 0.5, 0, 0.5, 0.5, 3, 0.5, 0.5, 7).finished());
  const Shape both = concatenate(solids::box({1, 1, 1}), needle);
  const std::vector<CollisionProbe> probes = probes_of(both, upwards, ContactSemantics::closed);
  REQUIRE(probes.size() == 1);
  CHECK(probes.front().place == ProbePlace::above);
  CHECK(surprises(both, upwards, probes) == 0);
}

TEST_CASE("a margin that is not positive is refused", "[collision_probes]") {
  const Shape box = solids::box({1, 1, 1});
  const Separation f_max = f_max_of(box, upwards, ContactSemantics::solid);
  for (const double margin : {0.0, -1e-9, std::numeric_limits<double>::quiet_NaN()})
    CHECK_THROWS_AS(collision_probes(box, upwards, f_max, {ContactSemantics::solid, margin}), UsageError);
  CHECK(to_string(ProbePlace::above) == "above");
  CHECK(to_string(ProbePlace::at) == "at");
  CHECK(to_string(ProbePlace::below) == "below");
}
