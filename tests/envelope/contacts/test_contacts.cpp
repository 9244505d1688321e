#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "stackabilization/core/errors.h"
#include "stackabilization/envelope/contacts.h"
#include "support/catch.h"
#include "support/directions.h"
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
  return contact_regions({shape, tree, direction, result}, options).regions;
}

std::vector<ContactRegion> contacts_along_z(const Shape& shape, double band) {
  ContactOptions options;
  options.band = band;
  return contacts(shape, Direction(0, 0, 1), options);
}

/// Areas are sums over a grid: a cell of it, 8 / 2^30 at most here, times the length of an outline.
constexpr double grid_area = 3e-7;

/// What does not depend on the frame.
struct Summary {
  int upper_part, lower_part, type;
  double area;
};

/// In an order that does not depend on the frame either.
std::vector<Summary> summaries(const std::vector<ContactRegion>& regions) {
  std::vector<Summary> result;
  for (const ContactRegion& region : regions)
    result.push_back({region.upper_part, region.lower_part, static_cast<int>(region.type), region.area});
  std::sort(result.begin(), result.end(), [](const Summary& a, const Summary& b) {
    return std::tie(a.upper_part, a.lower_part, a.type, a.area) <
           std::tie(b.upper_part, b.lower_part, b.type, b.area);
  });
  return result;
}

void check_same(const std::vector<Summary>& found, const std::vector<Summary>& expected) {
  REQUIRE(found.size() == expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    CHECK(found[k].upper_part == expected[k].upper_part);
    CHECK(found[k].lower_part == expected[k].lower_part);
    CHECK(found[k].type == expected[k].type);
    CHECK(found[k].area == Approx(expected[k].area).margin(grid_area));
  }
}

/// The identity and quarter turns about each axis and several: they round no coordinate.
std::vector<Eigen::Matrix3d> quarter_turns() {
  Eigen::Matrix3d about_x, about_z;
  about_x << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  about_z << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  return {Eigen::Matrix3d::Identity(), about_x,           about_z,
          about_x * about_z,           about_x * about_x, about_z * about_x * about_x * about_x};
}

/// Several parts; coordinates are multiples of 1/256, so that motions and midpoints are exact.
Shape soup_on_grid() {
  return triangle_soup({.seed = 3, .count = 60, .size = 1, .parts = 3, .grid_bits = 8});
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
  // f is 4.25 at rho = 3, where the foot ends. It falls inwards with the inner wall, by 7.5 over 1; outwards
  // by the difference of both walls, 0.5 over 1, to 4 at rho = 3.5, and then with the outer wall, by 8
  // over 1.
  FrustumShell cup;
  for (const int segments : {8, 64})
    for (const double eps : {0.008, 0.1, 0.4}) {
      cup.segments = segments;
      const std::vector<ContactRegion> regions = contacts_along_z(frustum_shell(cup), eps / cup.height);
      REQUIRE(regions.size() == 1);
      CHECK(regions[0].type == ContactType::ring);
      const double inner = 3 - eps / 7.5, outer = eps <= 0.25 ? 3 + 2 * eps : 3.5 + (eps - 0.25) / 8;
      const double polygon = segments / 2.0 * std::sin(2 * std::numbers::pi / segments);
      CHECK(regions[0].area == Approx(polygon * (outer * outer - inner * inner)).margin(grid_area));
    }
}

TEST_CASE(
    "the close portion of a cup is a ring of its projection, and that of a table its legs, then all of it") {
  const auto fit_of = [](const Shape& shape, const Direction& direction, double layer) {
    const SeparationTree tree(shape);
    const Separation found = separation(tree, tree, direction);
    ContactOptions options;
    options.band = layer / range_along(shape, frame_of(direction).w).length();
    return close_fit(shape, direction, contact_regions({shape, tree, direction, found}, options));
  };
  FrustumShell cup;
  for (const int segments : {8, 64})
    for (const double layer : {0.1, 0.4, 2.0}) {
      cup.segments = segments;
      const CloseFit fit = fit_of(frustum_shell(cup), upwards, layer);
      const double inner = 3 - layer / 7.5, outer = layer <= 0.25 ? 3 + 2 * layer : 3.5 + (layer - 0.25) / 8;
      const double polygon = segments / 2.0 * std::sin(2 * std::numbers::pi / segments);
      CHECK(fit.close_area == Approx(polygon * (outer * outer - inner * inner)).margin(grid_area));
      CHECK(fit.projected_area == Approx(16 * polygon).margin(grid_area));
      CHECK(fit.complete);
    }
  // Over the legs f is 6, elsewhere the 0.5 of the top.
  const Shape board = solids::table({});
  CHECK(fit_of(board, upwards, 0.1).share() == Approx(4.0 / 64).epsilon(1e-7));
  CHECK(fit_of(board, upwards, 5.4).share() == Approx(4.0 / 64).epsilon(1e-7));
  CHECK(fit_of(board, upwards, 5.6).share() == Approx(1).epsilon(1e-7));
  // In another pose and along a longer vector it is the same.
  const Eigen::Matrix3d turn = random_rotation(3);
  const CloseFit turned = fit_of(transformed(board, turn, {1, 2, 3}), Direction(3 * turn.col(2)), 0.1);
  CHECK(turned.share() == Approx(4.0 / 64).epsilon(1e-6));
  CHECK(turned.projected_area == Approx(64).epsilon(1e-6));
}

TEST_CASE("a shape whose projection has no area has no close portion") {
  const Shape wall =
      named(transformed(box({1, 1, 1}), Eigen::Vector3d(1, 0, 1).asDiagonal(), {0, 0, 0}), "wall");
  const SeparationTree tree(wall);
  const Separation found = separation(tree, tree, upwards);
  CHECK(close_fit(wall, upwards, contact_regions({wall, tree, upwards, found})).share() == 0);
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
      contacts(l_shape(4, 1), Direction(1, 0, 1), {ContactSemantics::solid, 0});
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
  const std::vector<ContactRegion> regions = contact_regions({shape, tree, r, exact}, options).regions;
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

TEST_CASE("regions do not depend on where the shape lies, how it is turned or how it is triangulated") {
  struct Example {
    Shape shape;
    Direction direction;
    double band;
  };
  const std::vector<Example> examples = {
      {solids::table({}), {0, 0, 1}, 0.01}, {frustum_shell({.segments = 8}), {0, 0, 1}, 0.001},
      {box({1, 8, 1}), {0, 0, 1}, 0},       {l_shape(4, 1), {1, 0, 1}, 0.01},
      {hook({}), {1, 2, 3}, 0.02},          {soup_on_grid(), {0.25, -0.5, 1}, 0.1}};
  for (const Example& example : examples) {
    const ContactOptions options{ContactSemantics::solid, example.band};
    const std::vector<Summary> expected = summaries(contacts(example.shape, example.direction, options));
    REQUIRE(!expected.empty());
    check_same(summaries(contacts(subdivided(example.shape), example.direction, options)), expected);
    for (const Eigen::Matrix3d& turn : quarter_turns()) {
      const Shape turned = transformed(example.shape, turn, Eigen::Vector3d(16, -8, 0.5));
      const Direction direction(turn * example.direction.vector());
      check_same(summaries(contacts(turned, direction, options)), expected);
    }
  }
}

TEST_CASE("contacts refuse a band outside [0, 1]") {
  CHECK_THROWS_AS(contacts_along_z(box({1, 1, 1}), -0.1), UsageError);
  CHECK_THROWS_AS(contacts_along_z(box({1, 1, 1}), std::nan("")), UsageError);
}
