#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

namespace stackabilization::solids {
namespace {

/// Area of the regular n-gon of circumradius 1.
double polygon_area(int n) {
  return n / 2.0 * std::sin(2 * std::numbers::pi / n);
}

double frustum_volume(double r0, double r1, double height, int n) {
  return polygon_area(n) * height * (r0 * r0 + r0 * r1 + r1 * r1) / 3;
}

struct Case {
  std::string name;
  Shape shape;
  double volume;
};

std::vector<Case> all_solids() {
  const FrustumShell cup{.outer_bottom = 3,
                         .outer_top = 4,
                         .inner_bottom = 2.5,
                         .inner_top = 3.5,
                         .height = 8,
                         .floor = 0.5,
                         .segments = 12};
  const Stairs steps{.count = 5, .tread = 1, .rise = 0.75, .width = 2, .thickness = 0.25};
  const Torus ring{.ring_radius = 3, .tube_radius = 1, .ring_segments = 24, .tube_segments = 16};
  const Polygon arrow = {{0, 0}, {2, -1}, {1, 0}, {2, 1}};
  // Stair plate: per step the tread, and the riser below it; the first riser ends at the ground, not under
  // it.
  const double plate =
      steps.width * steps.thickness *
      (steps.count * steps.tread + (steps.count - 1) * steps.rise + steps.rise - steps.thickness);
  // A ring of n-gons is a prism over each edge cut by mitres: the tube's area times n-gon perimeter at its
  // centroid.
  const double ring_volume = polygon_area(16) * 2 * 3 * polygon_area(24);
  return {
      {"box", box({1, 2, 3}), 6},
      {"boxes sharing a wall", boxes_sharing_wall(), 2},
      {"arrow prism", prism(arrow, 3), 3},
      {"extruded arrow", extruded_profile(arrow, 3), 3},
      {"tetrahedron", tetrahedron({{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}}}), 1.0 / 6},
      {"cylinder", cylinder(2, 5, 7), 20 * polygon_area(7)},
      {"frustum shell", frustum_shell(cup), frustum_volume(3, 4, 8, 12) - frustum_volume(2.5, 3.5, 7.5, 12)},
      {"stairs", stairs(steps), 2 * 0.75 * 15},
      {"stair plate", stair_plate(steps), plate},
      {"L", l_shape(4, 1), 7},
      {"U", u_shape(4, 1), 10},
      {"hook", hook({.length = 4, .height = 6, .thickness = 1}), 12},
      {"torus", torus(ring), ring_volume},
      {"table", table({.width = 8, .height = 6, .top = 0.5, .leg = 1}), 32 + 4 * 5.5},
  };
}

TEST_CASE("solids are closed, outward oriented and have the volume of their closed form") {
  for (const Case& solid : all_solids()) {
    INFO(solid.name);
    REQUIRE_NOTHROW(validate(solid.shape));
    CHECK(is_closed(solid.shape));
    CHECK(signed_volume(solid.shape) == Approx(solid.volume).epsilon(1e-12));
    for (Eigen::Index part = 0; part < solid.shape.part_count(); ++part)
      CHECK(signed_volume(extract_part(solid.shape, part)) > 0);
  }
}

TEST_CASE("the glass and the bin are closed and outward oriented") {
  for (const Shape& shape : {wine_glass(8), gridfinity_bin({}), gridfinity_bin({.units = 2, .seat = 0})}) {
    CHECK(is_closed(shape));
    CHECK(signed_volume(shape) > 0);
  }
}

TEST_CASE("a missing, a turned and a doubled triangle open a solid") {
  const Shape cube = box({1, 1, 1});
  Shape open = cube;
  open.triangles.conservativeResize(11, 3);
  open.triangle_part.pop_back();
  CHECK_FALSE(is_closed(open));
  Shape turned = cube;
  std::swap(turned.triangles(4, 0), turned.triangles(4, 1));
  CHECK_FALSE(is_closed(turned));
  Shape doubled = cube;
  doubled.triangles.row(3) = doubled.triangles.row(2);
  CHECK_FALSE(is_closed(doubled));
}

TEST_CASE("the sphere approaches the ball from inside and has its poles exactly") {
  double before = 0;
  for (int level = 0; level < 4; ++level) {
    const Shape shape = sphere(2, level);
    CHECK(is_closed(shape));
    CHECK(signed_volume(shape) > before);
    before = signed_volume(shape);
  }
  CHECK(before < 32 * std::numbers::pi / 3);
  CHECK(before > 0.97 * 32 * std::numbers::pi / 3);
  CHECK(sphere(2, 1).vertices.colwise().maxCoeff() == Eigen::RowVector3d::Constant(2));
}

TEST_CASE("quarter turns of circle points are exact") {
  for (const int n : {4, 12, 20, 48})
    for (int k = 0; k < n; ++k) {
      const Eigen::Vector2d p = circle_point(k, n), quarter = circle_point(k + n / 4, n);
      CHECK(quarter == Eigen::Vector2d(-p.y(), p.x()));
      CHECK((p -
             Eigen::Vector2d(std::cos(2 * std::numbers::pi * k / n), std::sin(2 * std::numbers::pi * k / n)))
                .norm() < 1e-15);
    }
  CHECK(circle_point(-1, 5) == circle_point(4, 5));
}

TEST_CASE("a bin of three units seats the next one at exactly 21 millimetres") {
  const Shape bin = gridfinity_bin({.units = 3});
  std::vector<double> heights;
  for (Eigen::Index v = 0; v < bin.vertex_count(); ++v) heights.push_back(bin.vertices(v, 2));
  CHECK(std::count(heights.begin(), heights.end(), 21.0) == 8);
  CHECK(*std::min_element(heights.begin(), heights.end()) == 0);
  CHECK(*std::max_element(heights.begin(), heights.end()) == Approx(25.4));
  CHECK(gridfinity_bin_f_max({.units = 3}) == 21);
}

TEST_CASE("closed forms of f_max agree where two of them apply") {
  const std::array<Eigen::Vector3d, 4> corners = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  CHECK(tetrahedron_f_max(corners, Direction(1, 0, 0)) == Approx(1));
  CHECK(tetrahedron_f_max(corners, Direction(1, 1, 1)) == Approx(1.0 / 3));
  CHECK(tetrahedron_f_max(corners, Direction(2, -2, 0)) == Approx(0.5));
  CHECK(box_f_max({1, 2, 3}, Direction(0, -4, 4)) == 0.5);
  // Walls of a cup that taper as fast outside as inside leave its floor or its wall's vertical thickness.
  CHECK(frustum_shell_f_max({.outer_bottom = 3,
                             .outer_top = 4,
                             .inner_bottom = 2.5,
                             .inner_top = 3.5,
                             .height = 8,
                             .floor = 0.5}) == Approx(4.25));
  // Straight walls do not nest at all.
  CHECK(frustum_shell_f_max({.outer_bottom = 4,
                             .outer_top = 4,
                             .inner_bottom = 3.5,
                             .inner_top = 3.5,
                             .height = 8,
                             .floor = 0.5}) == 8);
  CHECK(l_shape_f_max(4, 1, Direction(2, 0, 2)) == 0.5);
}

/// Largest u - l over a grid of lines along z, slightly off all symmetries of the solids: a lower bound of
/// f_max.
double sampled_f_max(const Shape& shape, int resolution) {
  const Eigen::RowVector3d low = shape.vertices.colwise().minCoeff(),
                           size = shape.vertices.colwise().maxCoeff() - low;
  double f_max = 0;
  for (int i = 0; i < resolution * resolution; ++i) {
    const Eigen::Vector2d q(low.x() + size.x() * (i % resolution + 0.503) / resolution,
                            low.y() + size.y() * (i / resolution + 0.491) / resolution);
    double lower = 1e300, upper = -1e300;
    for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
      Eigen::Matrix3d corners;
      for (int k = 0; k < 3; ++k) corners.col(k) << shape.corner(t, k).head<2>(), 1;
      const Eigen::Vector3d weights = corners.inverse() * Eigen::Vector3d(q.x(), q.y(), 1);
      if (!weights.allFinite() || weights.minCoeff() < 0) continue;
      const double z = weights.dot(
          Eigen::Vector3d(shape.corner(t, 0).z(), shape.corner(t, 1).z(), shape.corner(t, 2).z()));
      lower = std::min(lower, z);
      upper = std::max(upper, z);
    }
    f_max = std::max(f_max, upper - lower);
  }
  return f_max;
}

TEST_CASE("lines along z never see more than the closed form of f_max, and nearly as much") {
  const FrustumShell tight{.outer_bottom = 2,
                           .outer_top = 4,
                           .inner_bottom = 1.5,
                           .inner_top = 3.75,
                           .height = 8,
                           .floor = 1,
                           .segments = 16};
  const FrustumShell steep{.outer_bottom = 3,
                           .outer_top = 3.5,
                           .inner_bottom = 2.75,
                           .inner_top = 3,
                           .height = 8,
                           .floor = 0.5,
                           .segments = 16};
  const Stairs steps{.count = 5, .tread = 1, .rise = 0.75, .width = 2, .thickness = 0.25};
  const std::array<Eigen::Vector3d, 4> corners = {{{0, 0, 0}, {3, 1, 0}, {1, 4, 1}, {1, 1, 3}}};
  const std::vector<std::pair<Shape, double>> cases = {
      {box({1, 2, 3}), box_f_max({1, 2, 3}, Direction(0, 0, 1))},
      {boxes_sharing_wall(), 1},
      {tetrahedron(corners), tetrahedron_f_max(corners, Direction(0, 0, 1))},
      {frustum_shell(tight), frustum_shell_f_max(tight)},
      {frustum_shell(steep), frustum_shell_f_max(steep)},
      {stairs(steps), 3.75},
      {stair_plate(steps), stair_plate_f_max(steps)},
      {l_shape(4, 1), l_shape_f_max(4, 1, Direction(0, 0, 1))},
      {u_shape(4, 1), 4},
      {hook({}), 6},
      {wine_glass(8), 13},
      {torus({}), 2},
      {sphere(2, 2), 4},
      {table({}), 6},
      {gridfinity_bin({}), gridfinity_bin_f_max({})},
      {gridfinity_bin({.units = 2, .seat = 0}), gridfinity_bin_f_max({.units = 2, .seat = 0})}};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    INFO("case " << i);
    const double sampled = sampled_f_max(cases[i].first, 120);
    CHECK(sampled <= cases[i].second * (1 + 1e-12));
    CHECK(sampled >= cases[i].second * 0.97);
  }
}

TEST_CASE("variants keep the solid") {
  for (const Case& solid : all_solids()) {
    INFO(solid.name);
    CHECK(is_closed(subdivided(solid.shape)));
    CHECK(subdivided(solid.shape).triangle_count() == 4 * solid.shape.triangle_count());
    CHECK(signed_volume(subdivided(solid.shape)) == Approx(solid.volume).epsilon(1e-12));
    CHECK(surface_area(subdivided(solid.shape)) == Approx(surface_area(solid.shape)).epsilon(1e-12));
    const Shape shuffled = permuted(solid.shape, 7);
    CHECK(shuffled.triangles != solid.shape.triangles);
    CHECK(is_closed(shuffled));
    CHECK(signed_volume(shuffled) == Approx(solid.volume).epsilon(1e-12));
    CHECK(signed_volume(flipped(solid.shape)) == Approx(-solid.volume).epsilon(1e-12));
    const Shape turned = transformed(solid.shape, random_rotation(3), {1, -2, 3});
    CHECK(signed_volume(turned) == Approx(solid.volume).epsilon(1e-12));
  }
}

TEST_CASE("random shapes depend on the seed alone") {
  CHECK(Random(0).next() == 0xe220a8397b1dcdaf);  // First output of the reference SplitMix64.
  CHECK(triangle_soup({.seed = 5}).vertices == triangle_soup({.seed = 5}).vertices);
  CHECK(triangle_soup({.seed = 5}).vertices != triangle_soup({.seed = 6}).vertices);
  const Shape coarse = triangle_soup({.seed = 5, .count = 50, .size = 0.5, .parts = 3, .grid_bits = 2});
  CHECK_NOTHROW(validate(coarse));
  CHECK((coarse.vertices * 4).array().round().isApprox(coarse.vertices.array() * 4, 0));
  const Eigen::Matrix3d rotation = random_rotation(11);
  CHECK((rotation * rotation.transpose()).isIdentity(1e-14));
  CHECK(rotation.determinant() == Approx(1));
}

TEST_CASE("a polygon that crosses itself or runs clockwise is refused") {
  CHECK_THROWS(triangulate({{0, 0}, {0, 1}, {1, 1}, {1, 0}}));
}

}  // namespace
}  // namespace stackabilization::solids
