#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "improvement/requirements/draft.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

namespace stackabilization {
namespace {

constexpr int segments = 64;

/// Degrees between the axis and the facets of a cone that grows by `out` while it rises by `up`.
double facet_angle(double out, double up) {
  return std::atan(out * std::cos(std::numbers::pi / segments) / up) * 180 / std::numbers::pi;
}

double draft(const Shape& shape, const Direction& direction, const ContactOptions& options = {}) {
  const SeparationTree tree(shape);
  const Separation found = separation(tree, tree, direction, {options.semantics, std::nullopt});
  return contact_draft_degrees(shape, contact_regions({shape, tree, direction, found}, options).regions,
                               direction);
}

TEST_CASE("cups with even walls have the half angle of their cone") {
  solids::FrustumShell cup;
  for (const double flare : {0.75, 1.0, 3.0}) {
    cup.outer_top = cup.outer_bottom + flare;
    cup.inner_top = cup.inner_bottom + flare / cup.height * (cup.height - cup.floor);
    const Shape shape = solids::frustum_shell(cup);
    CHECK(draft(shape, Direction(0, 0, 1)) == Approx(facet_angle(flare, cup.height)));
    const Eigen::Matrix3d turn = solids::random_rotation(5);
    CHECK(draft(solids::flipped(transformed(shape, 2 * turn, {1, 2, 3})), Direction(4 * turn.col(2))) ==
          Approx(facet_angle(flare, cup.height)));
  }
}

TEST_CASE("a foot in a cup touches with its edge: the inner wall counts") {
  const solids::FrustumShell cup;
  CHECK(draft(solids::frustum_shell(cup), Direction(0, 0, 1)) ==
        Approx(facet_angle(cup.inner_top - cup.inner_bottom, cup.height - cup.floor)));
}

TEST_CASE("a peg with upright walls in a conical hole has the angle of the hole") {
  const Shape peg =
      solids::surface_of_revolution({{0, 0}, {1, 0}, {1, 2}, {3, 2}, {3, 6}, {2, 6}, {0, 3}}, segments);
  CHECK(draft(peg, Direction(0, 0, 1)) == Approx(facet_angle(2, 3)));
}

TEST_CASE("level contacts count as such, however steep the walls beside them") {
  CHECK(draft(solids::box(Eigen::Vector3d(1, 2, 3)), Direction(0, 0, 1)) == Approx(90));
  CHECK(draft(solids::table({}), Direction(0, 0, 1)) == Approx(90));
  for (const double top : {2.9, 3.1}) {
    const Shape post = solids::surface_of_revolution({{0, 0}, {3, 0}, {top, 8}, {0, 8}}, segments);
    CHECK(draft(post, Direction(0, 0, 1)) == Approx(90));
  }
}

ContactRegion region_of(const std::vector<ContactPolygon>& polygons) {
  ContactRegion region;
  region.upper_centre = region.lower_centre = region.long_axis = Eigen::Vector3d::Zero();
  region.polygons = polygons;
  return region;
}

TEST_CASE("walls along r have no draft") {
  // Right triangles over one wall, the second standing higher and further along.
  Points corners(6, 3);
  corners << 0, 0, 0, 4, 0, 0, 0, 0, 4, 1, 0, 1, 5, 0, 1, 1, 0, 5;
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 3, 4, 5;
  const Shape walls = make_shape(corners, triangles);
  const Points common = Eigen::RowVector3d(1.5, 0, 1.5);
  CHECK(contact_draft_degrees(walls, {region_of({{0, 1, common, common}})}, Direction(0, 0, 1)) == 0);
  CHECK(contact_draft_degrees(walls, {region_of({{0, 1, common, common}})}, Direction(0, 1, 1)) ==
        Approx(45));
}

TEST_CASE("no contact has all the draft there is") {
  const Shape cube = solids::box(Eigen::Vector3d(1, 1, 1));
  CHECK(contact_draft_degrees(cube, {}, Direction(0, 0, 1)) == 90);
  CHECK(contact_draft_degrees(cube, {region_of({})}, Direction(0, 0, 1)) == 90);
}

TEST_CASE("triangles without area are passed over") {
  Points corners(4, 3);
  corners << 0, 0, 0, 1, 0, 1, 2, 0, 2, 0, 3, 0;
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 0, 1, 3;
  const Shape shape = make_shape(corners, triangles);
  const Points point = corners.topRows(1);
  const ContactPolygon flat{0, 1, point, point}, sloped{1, 1, point, point};
  CHECK(contact_draft_degrees(shape, {region_of({flat})}, Direction(0, 0, 1)) == 90);
  CHECK(contact_draft_degrees(shape, {region_of({flat, sloped})}, Direction(0, 0, 1)) == Approx(45));
}

}  // namespace
}  // namespace stackabilization
