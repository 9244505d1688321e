#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "stackabilization/envelope/contacts.h"
#include "stackabilization/shape/errors.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;
using namespace stackabilization::solids;

namespace {

std::vector<ContactRegion> contacts(const Shape& shape, const Direction& direction,
                                    const ContactOptions& options = {}) {
  const SeparationTree tree(shape);
  SeparationOptions separation_options;
  separation_options.semantics = options.semantics;
  const Separation result = separation(tree, tree, direction, separation_options);
  return contact_regions(shape, tree, direction, result, options);
}

std::vector<ContactRegion> contacts_along_z(const Shape& shape, double band) {
  ContactOptions options;
  options.band = band;
  return contacts(shape, Direction(0, 0, 1), options);
}

double total_area(const std::vector<ContactRegion>& regions) {
  double sum = 0;
  for (const ContactRegion& region : regions) sum += region.area;
  return sum;
}

}  // namespace

TEST_CASE("a box touches its copy all over its top") {
  const std::vector<ContactRegion> regions = contacts_along_z(box({1, 2, 3}), 0);
  REQUIRE(regions.size() == 1);
  CHECK(regions[0].area == Approx(2).epsilon(1e-8));
  CHECK(regions[0].type == ContactType::dot);
  CHECK((regions[0].upper_centre - Eigen::Vector3d(0.5, 1, 3)).norm() < 1e-12);
  CHECK((regions[0].lower_centre - Eigen::Vector3d(0.5, 1, 0)).norm() < 1e-12);
}

TEST_CASE("four legs give four regions, each the foot of a leg") {
  const solids::Table options;
  const Shape shape = solids::table(options);
  const std::vector<ContactRegion> regions = contacts_along_z(shape, 0.01);
  REQUIRE(regions.size() == 4);
  std::vector<std::string> lower;
  for (const ContactRegion& region : regions) {
    CHECK(region.type == ContactType::dot);
    CHECK(region.area == Approx(options.leg * options.leg).epsilon(1e-8));
    CHECK(shape.part_names[region.upper_part] == "top");
    lower.push_back(shape.part_names[region.lower_part]);
  }
  std::sort(lower.begin(), lower.end());
  CHECK(lower == std::vector<std::string>{"leg_1", "leg_2", "leg_3", "leg_4"});
}

TEST_CASE("a cup touches in one ring, whose area is the band's") {
  // Both walls are cones of one slope: f is constant along the wall, and on the band up to the knees f falls
  // linearly.
  FrustumShell cup;
  for (const int segments : {8, 64}) {
    cup.segments = segments;
    const std::vector<ContactRegion> regions = contacts_along_z(frustum_shell(cup), 0.001);
    REQUIRE(regions.size() == 1);
    CHECK(regions[0].type == ContactType::ring);
  }
}

TEST_CASE("the area of a union does not count overlaps twice") {
  const Shape cube = box({1, 2, 3});
  const double single = total_area(contacts_along_z(cube, 0));
  CHECK(total_area(contacts_along_z(concatenate(cube, cube), 0)) == Approx(4 * single).epsilon(1e-8));
  Shape doubled = concatenate(cube, cube);
  std::fill(doubled.triangle_part.begin(), doubled.triangle_part.end(), 0);
  doubled.part_names.resize(1);
  CHECK(total_area(contacts_along_z(doubled, 0)) == Approx(single).epsilon(1e-8));
}

TEST_CASE("regions are seen along r, not along an axis of the file") {
  // Along (1, 0, 1) an L rests on its inner corner and along both inner walls.
  const std::vector<ContactRegion> regions =
      contacts(l_shape(4, 1), Direction(1, 0, 1), {Semantics::solid, 0});
  double expected = 0;
  // Inner side of the standing arm (3 x 1) and top of the lying arm (3 x 1), both seen at 45 degrees.
  expected = 2 * 3 * std::numbers::sqrt2 / 2;
  CHECK(total_area(regions) == Approx(expected).epsilon(1e-8));
}

TEST_CASE("a long contact is a line along its axis") {
  const std::vector<ContactRegion> regions = contacts_along_z(box({1, 8, 1}), 0);
  REQUIRE(regions.size() == 1);
  CHECK(regions[0].type == ContactType::line);
  CHECK(std::abs(regions[0].long_axis.y()) == Approx(1));
}

TEST_CASE("every polygon lies on both surfaces, one f above the other") {
  Soup soup;
  soup.size = 1;
  soup.count = 40;
  const Shape shape = triangle_soup(soup);
  const SeparationTree tree(shape);
  const Direction r(0.3, -0.2, 1);
  const Separation exact = separation(tree, tree, r);
  ContactOptions options;
  options.band = 0.05;
  const std::vector<ContactRegion> regions = contact_regions(shape, tree, r, exact, options);
  REQUIRE(!regions.empty());
  const auto distance = [&](std::int32_t triangle, const Eigen::Vector3d& p) {
    const Eigen::Vector3d a = shape.corner(triangle, 0);
    const Eigen::Vector3d normal =
        (shape.corner(triangle, 1) - a).cross(shape.corner(triangle, 2) - a).normalized();
    return std::abs(normal.dot(p - a));
  };
  double highest = 0;
  for (const ContactRegion& region : regions)
    for (const ContactPolygon& polygon : region.polygons) {
      CHECK(shape.triangle_part[polygon.upper_triangle] == region.upper_part);
      for (Eigen::Index p = 0; p < polygon.upper_points.rows(); ++p) {
        const Eigen::Vector3d upper = polygon.upper_points.row(p), lower = polygon.lower_points.row(p);
        CHECK(distance(polygon.upper_triangle, upper) < 1e-9);
        CHECK(distance(polygon.lower_triangle, lower) < 1e-9);
        CHECK((upper - lower).cross(r.unit()).norm() < 1e-9);
        highest = std::max(highest, (upper - lower).dot(r.unit()));
        CHECK((upper - lower).dot(r.unit()) >= exact.length - 0.05 * 4);
      }
    }
  CHECK(highest == Approx(exact.length).epsilon(1e-9));
}

TEST_CASE("a contact without area is a point") {
  const std::array<Eigen::Vector3d, 4> corners{{{0, 0, 0}, {4, 0, 1}, {0, 4, 1}, {1, 1, 4}}};
  const std::vector<ContactRegion> regions = contacts_along_z(tetrahedron(corners), 0);
  REQUIRE(regions.size() == 1);
  CHECK(regions[0].area < 1e-12);
  CHECK(regions[0].type == ContactType::dot);
  CHECK(regions[0].upper_centre.allFinite());
}

TEST_CASE("contacts refuse a band outside [0, 1]") {
  CHECK_THROWS_AS(contacts_along_z(box({1, 1, 1}), -0.1), UsageError);
  CHECK_THROWS_AS(contacts_along_z(box({1, 1, 1}), std::nan("")), UsageError);
}
