#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "stackabilization/core/errors.h"
#include "stackabilization/mesh/boxes.h"
#include "support/catch.h"
#include "support/point_sets.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;
using point_sets::Random;

namespace {

double minimal_volume(const Points& points) {
  return minimal_oriented_box(HullSupport(points)).volume();
}

/// Largest distance by which a point sticks out of the box.
double overhang_of_box(const OrientedBox& box, const Points& points) {
  const Points local = (points.rowwise() - box.centre.transpose()) * box.axes;
  return (local.cwiseAbs().rowwise() - box.half_extents.transpose()).maxCoeff();
}

void check_axes(const OrientedBox& box) {
  CHECK((box.axes.transpose() * box.axes - Eigen::Matrix3d::Identity()).norm() < 1e-14);
  CHECK(box.axes.determinant() == Approx(1));
}

/// Smallest rectangle around the projection by trying the direction of every pair of points.
double rectangle_area_by_pairs(const Points& points, const Direction& direction) {
  const Frame frame = frame_of(direction);
  Eigen::Matrix2Xd flat(2, points.rows());
  flat.row(0) = (points * frame.u).transpose();
  flat.row(1) = (points * frame.v).transpose();
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < flat.cols(); ++i)
    for (Eigen::Index j = 0; j < i; ++j) {
      const Eigen::Vector2d along = (flat.col(i) - flat.col(j)).normalized();
      if (along.isZero()) continue;
      const Eigen::VectorXd a = flat.transpose() * along;
      const Eigen::VectorXd b = flat.transpose() * Eigen::Vector2d(-along.y(), along.x());
      least = std::min(least, (a.maxCoeff() - a.minCoeff()) * (b.maxCoeff() - b.minCoeff()));
    }
  return least;
}

/// Smallest box met when one normal runs densely over every great circle orthogonal to a difference of two
/// points.
double box_volume_by_brute_force(const Points& points, int steps) {
  const HullSupport hull(points);
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    for (Eigen::Index j = 0; j < i; ++j) {
      const Frame frame = frame_of(Direction((points.row(i) - points.row(j)).transpose()));
      for (int k = 0; k < steps; ++k) {
        const double angle = std::numbers::pi * k / steps;
        least = std::min(
            least, hull.box_along(Direction(frame.u * std::cos(angle) + frame.v * std::sin(angle))).volume());
      }
    }
  return least;
}

std::vector<std::pair<std::string, Points>> families() {
  Points stair(12, 3);
  stair << 0, 0, 0, 3, 0, 0, 3, 0, 1, 1, 0, 1, 1, 0, 2, 0, 0, 2,  //
      0, 2, 0, 3, 2, 0, 3, 2, 1, 1, 2, 1, 1, 2, 2, 0, 2, 2;
  return {{"box", point_sets::box({1, 2, 3})},
          {"plate", point_sets::box({1, 2, 1e-3})},
          {"tetrahedron", point_sets::tetrahedron()},
          {"stair", stair},
          {"pyramid", point_sets::frustum(4, 1, 0, 1.3)},
          {"prism with 5 sides", point_sets::frustum(5, 1, 1, 0.7)},
          {"cylinder", point_sets::frustum(20, 1, 1, 3)},
          {"cup", point_sets::frustum(18, 0.8, 1, 1.2)},
          {"8 points", point_sets::in_ball(8, 1)},
          {"40 points", point_sets::in_ball(40, 2)},
          {"200 points", point_sets::in_ball(200, 3)},
          {"sphere of 60 points", point_sets::on_sphere(60, 4)}};
}

}  // namespace

TEST_CASE(
    "the hull of a box has six faces, twelve edges, eight corners, however it is triangulated or turned") {
  Points cut(125, 3);
  for (int i = 0; i < 125; ++i) cut.row(i) << i % 5 / 4.0, i / 5 % 5 / 2.0, i / 25 * 0.75;
  Random random(5);
  for (int pose = 0; pose < 20; ++pose) {
    const HullSupport hull(pose == 0 ? cut : point_sets::moved(cut, random.rotation(), random.vector(10)));
    CHECK(hull.points().rows() == 8);
    REQUIRE(hull.face_normals().rows() == 6);
    CHECK(hull.edges().rows() == 12);
    const double areas[] = {6, 6, 3, 3, 2, 2};
    for (int f = 0; f < 6; ++f) CHECK(hull.face_areas()[f] == Approx(areas[f]).epsilon(1e-12));
    for (Eigen::Index e = 0; e < 12; ++e) {
      const Eigen::Vector3d along =
          hull.points().row(hull.edges()(e, 0)) - hull.points().row(hull.edges()(e, 1));
      for (int side = 0; side < 2; ++side)
        CHECK(std::abs(hull.face_normals().row(hull.edge_faces()(e, side)).dot(along)) < 1e-13);
    }
  }
}

TEST_CASE("hull faces point outwards and close up") {
  for (const auto& [name, points] : families()) {
    INFO(name);
    const HullSupport hull(points);
    const Eigen::Vector3d closing = hull.face_normals().transpose() * hull.face_areas();
    CHECK(closing.norm() < 1e-12 * hull.face_areas().sum());
    CHECK(hull.points().rows() - hull.edges().rows() + hull.face_normals().rows() == 2);  // Euler
    for (Eigen::Index e = 0; e < hull.edges().rows(); ++e)
      for (int side = 0; side < 2; ++side) {
        const Eigen::Vector3d normal = hull.face_normals().row(hull.edge_faces()(e, side)).transpose();
        const double height = hull.points().row(hull.edges()(e, 0)).dot(normal);
        CHECK((points * normal).maxCoeff() == Approx(height).margin(1e-12));
      }
  }
}

TEST_CASE("extent and rectangle agree with brute force over all points") {
  Random random(6);
  for (const auto& [name, points] : families()) {
    INFO(name);
    const HullSupport hull(points);
    for (int i = 0; i < (points.rows() > 100 ? 3 : 20); ++i) {
      const Direction r(i < 3 ? Eigen::Vector3d(Eigen::Vector3d::Unit(i))
                              : Eigen::Vector3d(random.unit() * 3));
      const Eigen::VectorXd heights = points * r.unit();
      const double extent = heights.maxCoeff() - heights.minCoeff(),
                   area = rectangle_area_by_pairs(hull.points(), r);
      CHECK(hull.extent(r) == Approx(extent).epsilon(1e-13));
      CHECK(hull.minimal_rectangle_area(r) == Approx(area).epsilon(1e-12));
      const OrientedBox box = hull.box_along(r);
      CHECK(box.volume() == Approx(extent * area).epsilon(1e-12));
      CHECK(box.axes.col(2).dot(r.unit()) == Approx(1));
      check_axes(box);
      CHECK(overhang_of_box(box, points) < 1e-13);
    }
  }
}

TEST_CASE("a turned box is its own minimal box") {
  Random random(7);
  for (const Eigen::Vector3d& size :
       std::vector<Eigen::Vector3d>{{1, 1, 1}, {1, 2, 3}, {100, 1, 1}, {5, 7, 0.01}})
    for (int pose = 0; pose < 20; ++pose) {
      const Points points = point_sets::moved(point_sets::box(size), random.rotation(), random.vector(1));
      const OrientedBox box = minimal_oriented_box(HullSupport(points));
      CHECK(box.volume() == Approx(size.prod()).epsilon(1e-12));
      check_axes(box);
      CHECK(overhang_of_box(box, points) < 1e-12 * size.norm());
    }
}

TEST_CASE("minimal boxes known in closed form") {
  // The cube around a regular tetrahedron: a^3 / (2 sqrt 2) = 8 for a = sqrt 8.
  CHECK(minimal_volume(point_sets::tetrahedron()) == Approx(8).epsilon(1e-12));
  // A prism over a regular polygon stands in a box over the polygon's smallest rectangle.
  const double flat_to_flat = 2 * std::cos(std::numbers::pi / 48);
  CHECK(minimal_volume(point_sets::frustum(48, 1, 1, 3)) ==
        Approx(3 * flat_to_flat * flat_to_flat).epsilon(1e-12));
  CHECK(minimal_volume(point_sets::frustum(3, 1, 1, 2)) == Approx(2 * 1.5 * std::sqrt(3)).epsilon(1e-12));
  CHECK(minimal_volume(point_sets::frustum(6, 1, 1, 1)) == Approx(2 * std::sqrt(3)).epsilon(1e-12));
}

TEST_CASE("the minimal box is not larger than any box of a dense brute force") {
  for (std::uint32_t seed = 20; seed < 28; ++seed) {
    const Points points = point_sets::in_ball(4 + static_cast<int>(seed) % 4 * 2, seed);
    const double brute = box_volume_by_brute_force(points, 400);
    const double volume = minimal_volume(points);
    CHECK(volume <= brute * (1 + 1e-12));
    CHECK(volume >= brute * 0.99);
  }
}

TEST_CASE("the minimal volume does not depend on the pose") {
  Random random(8);
  for (const auto& [name, points] : families()) {
    INFO(name);
    const double volume = minimal_volume(points);
    for (int pose = 0; pose < 50; ++pose) {
      const double scale = std::exp(random.uniform(-5, 5));
      const Points turned = point_sets::moved(points, scale * random.rotation(), scale * random.vector(2));
      CHECK(minimal_volume(turned) == Approx(volume * scale * scale * scale).epsilon(1e-9));
    }
  }
}

TEST_CASE("the minimal volume of the test solids does not depend on the pose") {
  const std::vector<Shape> shapes = {solids::boxes_sharing_wall(),
                                     solids::frustum_shell({.segments = 12}),
                                     solids::stairs({}),
                                     solids::stair_plate({}),
                                     solids::l_shape(4, 1),
                                     solids::u_shape(3, 0.5),
                                     solids::hook({}),
                                     solids::wine_glass(8),
                                     solids::table({}),
                                     solids::torus({.ring_segments = 12, .tube_segments = 8}),
                                     solids::sphere(1, 1),
                                     solids::gridfinity_bin({}),
                                     solids::prism(solids::regular_polygon(7), 2),
                                     solids::triangle_soup({.seed = 2, .count = 30})};
  Random random(12);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    INFO("shape " << i);
    const double volume = minimal_oriented_box(HullSupport(shapes[i])).volume();
    for (int pose = 0; pose < 10; ++pose) {
      const HullSupport turned(transformed(shapes[i], 0.1 * random.rotation(), random.vector(1)));
      CHECK(minimal_oriented_box(turned).volume() == Approx(volume * 1e-3).epsilon(1e-9));
    }
  }
}

TEST_CASE("the order and repetition of points do not change a bit") {
  std::vector<std::vector<char>> blocks;  // shift what the heap hands out
  for (int seed = 9; seed < 29; ++seed) {
    const Points points = point_sets::in_ball(60, seed);
    Points shuffled(120, 3);
    for (int i = 0; i < 120; ++i) shuffled.row(i) = points.row(i * 37 % 60);
    const HullSupport a(points);
    for (int size = 16; size < 20000; size = 3 * size) blocks.emplace_back(size + seed);
    const HullSupport b(shuffled);
    REQUIRE(a.points() == b.points());
    REQUIRE(a.face_normals() == b.face_normals());
    CHECK(minimal_oriented_box(a).half_extents == minimal_oriented_box(b).half_extents);
  }
}

TEST_CASE("where the points lie in memory does not change a bit") {
  // Flat faces of many corners on a cup-like body: how quickhull cuts and orders them depends on addresses.
  Points rings(96, 3);
  for (int i = 0; i < 48; ++i) {
    const double angle = 2 * 3.14159265358979 * i / 48;
    rings.row(i) << 3 * std::cos(angle), 3 * std::sin(angle), 0;
    rings.row(48 + i) << 4 * std::cos(angle), 4 * std::sin(angle), 9;
  }
  const Points points = point_sets::moved(rings, Random(3).rotation(), {0.1, 0.2, 0.3});
  const HullSupport first(points);
  std::vector<std::vector<char>> ballast;
  for (int run = 1; run <= 20; ++run) {
    ballast.emplace_back(static_cast<std::size_t>(1000 * run + 17));
    const HullSupport other(points);
    CHECK(first.face_normals() == other.face_normals());
    CHECK(first.face_areas() == other.face_areas());
    CHECK(first.edges() == other.edges());
    CHECK(minimal_oriented_box(first).half_extents == minimal_oriented_box(other).half_extents);
  }
}

TEST_CASE("bodies about as thick as the resolution have a box") {
  for (const double thickness : {1e-15, 1e-14, 5e-14, 1e-13, 2e-13, 1e-12}) {
    const Points slab =
        point_sets::moved(point_sets::box({2, 3, thickness}), Random(4).rotation(), {0, 0, 0});
    const Eigen::Vector3d extents = 2 * minimal_oriented_box(HullSupport(slab)).half_extents;
    CHECK(extents.allFinite());
    CHECK(extents.maxCoeff() == Approx(3));
    CHECK(extents.minCoeff() <= 2e-12);
  }
}

TEST_CASE("flat, straight and single-point sets have boxes without volume") {
  Random random(10);
  for (int pose = 0; pose < 10; ++pose) {
    const Eigen::Matrix3d rotation = random.rotation();
    const Eigen::Vector3d shift = random.vector(5);
    const Points square = point_sets::moved(point_sets::box({2, 3, 0}), rotation, shift);
    const HullSupport flat(square);
    CHECK(flat.points().rows() == 4);
    CHECK(flat.face_normals().rows() == 2);
    CHECK(flat.face_areas()[0] == Approx(6));
    Eigen::Vector3d extents = 2 * minimal_oriented_box(flat).half_extents;
    std::sort(extents.begin(), extents.end());
    CHECK(extents.isApprox(Eigen::Vector3d(0, 2, 3), 1e-12));
    CHECK(flat.minimal_rectangle_area(Direction(rotation.col(2))) == Approx(6));
    CHECK(flat.minimal_rectangle_area(Direction(rotation.col(0))) == Approx(0).margin(1e-12));
    CHECK(flat.extent(Direction(rotation.col(0))) == Approx(2));

    const HullSupport straight(point_sets::moved(point_sets::box({0, 0, 4}), rotation, shift));
    CHECK(straight.points().rows() == 2);
    CHECK(straight.face_normals().rows() == 0);
    CHECK(minimal_oriented_box(straight).half_extents.maxCoeff() == Approx(2));
    CHECK(minimal_oriented_box(straight).volume() == Approx(0).margin(1e-12));

    const HullSupport single(point_sets::moved(point_sets::box({0, 0, 0}), rotation, shift));
    CHECK(single.points().rows() == 1);
    CHECK(minimal_oriented_box(single).half_extents.isZero());
    CHECK((minimal_oriented_box(single).centre - shift).norm() == 0);
  }
}

TEST_CASE("only vertices that triangles use count") {
  Points vertices(5, 3);
  vertices << 0, 0, 0, 9, 9, 9, 1, 0, 0, 0, 1, 0, std::numeric_limits<double>::quiet_NaN(), 0, 0;
  Triangles triangles(1, 3);
  triangles << 0, 2, 3;
  CHECK(HullSupport(make_shape(vertices, triangles)).points().rows() == 3);
}

TEST_CASE("boxes refuse what has none") {
  CHECK_THROWS_AS(HullSupport(Points(0, 3)), InputError);
  Points points = point_sets::tetrahedron();
  points(2, 1) = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(HullSupport(points), InputError);
  CHECK_THROWS_AS(axis_aligned_box(points), InputError);
}

TEST_CASE("the axis-aligned and the frame box") {
  const Points points = point_sets::moved(point_sets::box({1, 2, 3}), Eigen::Matrix3d::Identity(), {4, 5, 6});
  const OrientedBox aligned = axis_aligned_box(points);
  CHECK(aligned.centre == Eigen::Vector3d(4.5, 6, 7.5));
  CHECK(aligned.half_extents == Eigen::Vector3d(0.5, 1, 1.5));
  // z to x: the box is measured along x, y, z again.
  CHECK(frame_box(points, Direction(1, 0, 0)).volume() == Approx(6));
  // Tilted by 45 degrees in the y-z plane: sides 1 and (2 + 3) / sqrt 2 twice.
  const OrientedBox tilted = frame_box(points, Direction(0, 1, 1));
  CHECK(tilted.volume() == Approx(12.5));
  CHECK(overhang_of_box(tilted, points) < 1e-14);
  check_axes(tilted);
}

TEST_CASE("bodies of thousands of corners have the boxes that closed forms say, in every pose") {
  // Too many corners to search all over: prisms over regular polygons, and boxes with round edges.
  Random random(31);
  const double flat_to_flat = 2 * std::cos(std::numbers::pi / 1024);
  const Points prism = point_sets::frustum(1024, 1, 1, 3), disc = point_sets::frustum(1024, 1, 1, 1e-6);
  REQUIRE(HullSupport(prism).points().rows() == 2048);
  Points rounded = point_sets::on_sphere(20000, 5);
  for (auto row : rounded.rowwise()) {  // |x / 4|^8 + |y / 3|^8 + |z / 2|^8 = 1
    row /= std::pow(row.array().pow(8).sum(), 1.0 / 8);
    row.array() *= Eigen::RowVector3d(4, 3, 2).array();
  }
  REQUIRE(HullSupport(rounded).points().rows() > 5000);
  for (int pose = 0; pose < 4; ++pose) {
    const auto turned = [&](const Points& points) {
      return point_sets::moved(points,
                               pose == 0 ? Eigen::Matrix3d(Eigen::Matrix3d::Identity()) : random.rotation(),
                               random.vector(2));
    };
    CHECK(minimal_volume(turned(prism)) == Approx(3 * flat_to_flat * flat_to_flat).epsilon(1e-9));
    CHECK(minimal_volume(turned(disc)) == Approx(1e-6 * flat_to_flat * flat_to_flat).epsilon(1e-8));
    const double volume = minimal_volume(turned(rounded));
    CHECK(volume <= axis_aligned_box(rounded).volume() * (1 + 1e-9));
    CHECK(volume > 191.5);
  }
}

TEST_CASE("a large sphere is boxed within a fraction of a second") {
  const OrientedBox box = minimal_oriented_box(HullSupport(point_sets::on_sphere(10000, 11)));
  CHECK(box.volume() < 8);
  CHECK(box.volume() > 7.95);
}
