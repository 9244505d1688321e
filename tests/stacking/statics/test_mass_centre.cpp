#include <cmath>

#include "stackabilization/core/errors.h"
#include "stacking/statics/mass_centre.h"
#include "support/catch.h"
#include "support/messages.h"
#include "support/solids.h"
#include "support/variants.h"

namespace stackabilization::mass_centre_test {

using detail::mass_centre;
using detail::MassCentre;

namespace {

/// Without its last triangle, and so open.
Shape opened(Shape shape) {
  shape.triangles.conservativeResize(shape.triangles.rows() - 1, 3);
  shape.triangle_part.pop_back();
  return shape;
}

}  // namespace

TEST_CASE("the mass of a tetrahedron is centred at the mean of its corners") {
  solids::Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const std::array<Eigen::Vector3d, 4> corners = {random.in_cube(), random.in_cube(), random.in_cube(),
                                                    random.in_cube()};
    const MassCentre found = mass_centre(solids::tetrahedron(corners));
    CHECK(found.of_solid);
    CHECK((found.centre - (corners[0] + corners[1] + corners[2] + corners[3]) / 4).norm() < 1e-12);
  }
}

TEST_CASE("the mass of a frustum of a cone, solid and open, in closed form") {
  // Over the height h the section goes as (R + (r - R) z / h)^2, with the same factor for any regular n-gon.
  const double big = 3, small = 1, height = 4;
  const Shape frustum = solids::surface_of_revolution({{0, 0}, {big, 0}, {small, height}, {0, height}}, 24);
  const double solid = height * (big * big + 2 * big * small + 3 * small * small) /
                       (4 * (big * big + big * small + small * small));
  const MassCentre found = mass_centre(frustum);
  CHECK(found.of_solid);
  CHECK((found.centre - Eigen::Vector3d(0, 0, solid)).norm() < 1e-12);

  // A cone without its bottom: triangles from the tip, so that its area is centred at a third of the height.
  Shape cone = solids::surface_of_revolution({{0, 0}, {big, 0}, {0, height}}, 24);
  Triangles side(0, 3);
  for (Eigen::Index t = 0; t < cone.triangle_count(); ++t)
    if ((cone.corner(t, 0) + cone.corner(t, 1) + cone.corner(t, 2)).z() > 0) {
      side.conservativeResize(side.rows() + 1, 3);
      side.bottomRows<1>() = cone.triangles.row(t);
    }
  const MassCentre open = mass_centre(make_shape(cone.vertices, side));
  CHECK_FALSE(open.of_solid);
  CHECK((open.centre - Eigen::Vector3d(0, 0, height / 3)).norm() < 1e-12);
}

TEST_CASE("the centre of mass goes along with the shape, and its triangles do not matter") {
  solids::Random random(5);
  for (const Shape& shape : {solids::l_shape(3, 1), solids::wine_glass(12), opened(solids::l_shape(3, 1))}) {
    const MassCentre rest = mass_centre(shape);
    for (int trial = 0; trial < 5; ++trial) {
      const Eigen::Matrix3d rotation = solids::random_rotation(static_cast<std::uint64_t>(trial));
      const Eigen::Vector3d shift = 100 * random.in_cube();
      const MassCentre moved = mass_centre(solids::permuted(transformed(shape, rotation, shift), 3));
      CHECK(moved.of_solid == rest.of_solid);
      CHECK((moved.centre - rotation * rest.centre - shift).norm() < 1e-10);
    }
    CHECK((mass_centre(solids::subdivided(shape)).centre - rest.centre).norm() < 1e-12);
    CHECK((mass_centre(solids::flipped(shape)).centre - rest.centre).norm() < 1e-12);
  }
}

TEST_CASE("of bodies that do not enclose each other the masses add up, of a body in a cavity as well") {
  const Shape low = solids::box({0, 0, 0}, {1, 1, 1}), high = solids::box({5, 0, 0}, {6, 1, 3});
  // 1 at z = 0.5 and 3 at z = 1.5.
  for (const Shape& both : {concatenate(low, high), concatenate(solids::flipped(low), high)})
    CHECK(
        mass_centre(both).centre.isApprox(Eigen::Vector3d((0.5 + 3 * 5.5) / 4, 0.5, (0.5 + 4.5) / 4), 1e-14));
  // 1000 - 27 + 1, of which only the cavity and what it holds are off the middle.
  const Shape outer = solids::box({0, 0, 0}, {10, 10, 10}),
              cavity = solids::flipped(solids::box({6, 6, 6}, {9, 9, 9})),
              held = solids::box({7.5, 7.5, 7.5}, {8.5, 8.5, 8.5});
  const double expected = (1000 * 5 - 27 * 7.5 + 8.0) / (1000 - 27 + 1);
  const Shape nested = concatenate(concatenate(outer, cavity), held);
  for (const Shape& turned : {nested, solids::flipped(nested)})
    CHECK(mass_centre(turned).centre.z() == Approx(expected).epsilon(1e-14));
}

TEST_CASE("a sheet with two sides counts by its area, and what has no area is refused") {
  Points corners(3, 3);
  corners << 0, 0, 7, 3, 0, 7, 0, 3, 7;
  Triangles both(2, 3);
  both << 0, 1, 2, 0, 2, 1;
  const MassCentre sheet = mass_centre(make_shape(corners, both));
  CHECK_FALSE(sheet.of_solid);
  CHECK((sheet.centre - Eigen::Vector3d(1, 1, 7)).norm() < 1e-12);
  corners.col(1).setZero();
  CHECK(mentions(message_of<InputError>([&] { mass_centre(make_shape(corners, both)); }), "no area"));
}

}  // namespace stackabilization::mass_centre_test
