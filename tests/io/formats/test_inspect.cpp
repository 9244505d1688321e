#include <cmath>
#include <tuple>

#include "stackabilization/io/inspect.h"
#include "support/catch.h"
#include "support/meshes.h"
#include "support/variants.h"

using namespace stackabilization;
using namespace stackabilization::test;

namespace {

Shape with_triangles(const Shape& shape, const std::vector<std::array<std::int32_t, 3>>& extra) {
  Triangles triangles = shape.triangles;
  triangles.conservativeResize(shape.triangle_count() + static_cast<Eigen::Index>(extra.size()), 3);
  for (std::size_t i = 0; i < extra.size(); ++i)
    for (int corner = 0; corner < 3; ++corner)
      triangles(shape.triangle_count() + static_cast<Eigen::Index>(i), corner) =
          extra[i][static_cast<std::size_t>(corner)];
  return make_shape(shape.vertices, triangles);
}

/// Every triangle with corners of its own, as STL has them.
Shape exploded(const Shape& shape) {
  Points vertices(3 * shape.triangle_count(), 3);
  Triangles triangles(shape.triangle_count(), 3);
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      triangles(t, corner) = static_cast<std::int32_t>(3 * t + corner);
      vertices.row(3 * t + corner) = shape.corner(t, corner).transpose();
    }
  return make_shape(vertices, triangles);
}

std::int64_t self_intersections(const Shape& shape) {
  return *inspect(shape, {InspectOptions::SelfIntersections::count}).self_intersections;
}

}  // namespace

TEST_CASE("a cube has nothing wrong with it") {
  for (const Shape& shape : {cube(2), exploded(cube(2))}) {
    const Findings findings = inspect(shape, {InspectOptions::SelfIntersections::count});
    CHECK(findings.triangles == 12);
    CHECK(findings.distinct_points == 8);
    CHECK(findings.components == 1);
    CHECK(findings.boundary_edges + findings.non_manifold_edges + findings.inconsistent_edges == 0);
    CHECK(findings.degenerate_faces + findings.duplicate_faces + findings.unreferenced_vertices == 0);
    CHECK(findings.self_intersections == 0);
    CHECK(findings.closed);
    CHECK(findings.oriented_outward);
    CHECK(findings.volume == Approx(8));
    CHECK(findings.upper == Eigen::Vector3d(2, 2, 2));
    CHECK_FALSE(findings.likely_up.has_value());
    CHECK(brief(findings).ends_with("1 part, 2 x 2 x 2, closed"));
  }
}

TEST_CASE("a cube inside out has a negative volume, wherever it lies") {
  Shape shape = solids::moved(cube(), {1000, -2000, 3000});
  shape.triangles.col(0).swap(shape.triangles.col(1));
  const Findings findings = inspect(shape);
  CHECK(findings.volume == Approx(-1));
  CHECK_FALSE(findings.oriented_outward);
  CHECK(brief(findings).find("oriented inwards") != std::string::npos);
}

TEST_CASE("edges are counted by their triangles and directions") {
  Shape open = cube();
  open.triangles.conservativeResize(10, 3);
  open.triangle_part.resize(10);
  CHECK(inspect(open).boundary_edges == 4);
  CHECK_FALSE(inspect(open).volume.has_value());

  Shape flipped = cube();
  std::swap(flipped.triangles(3, 0), flipped.triangles(3, 1));
  CHECK(inspect(flipped).inconsistent_edges == 3);
  CHECK(inspect(flipped).closed);
  CHECK_FALSE(inspect(flipped).volume.has_value());

  const Findings fin = inspect(with_triangles(cube(), {{0, 1, 7}}));
  CHECK(fin.non_manifold_edges ==
        2);  // 0-1 is an edge of the cube, 1-7 a diagonal, 7-0 runs through its inside.
  CHECK(fin.boundary_edges == 1);
}

TEST_CASE("cubes that share an edge or a corner are one component, apart they are two") {
  CHECK(inspect(concatenate(cube(), solids::moved(cube(), {1, 1, 0}))).components == 1);
  CHECK(inspect(concatenate(cube(), solids::moved(cube(), {1, 1, 0}))).non_manifold_edges == 1);
  CHECK(inspect(concatenate(cube(), solids::moved(cube(), {1, 1, 0}))).volume == Approx(2));
  CHECK(inspect(concatenate(cube(), solids::moved(cube(), {1, 1, 1}))).components == 1);
  CHECK(inspect(concatenate(cube(), solids::moved(cube(), {5, 0, 0}))).components == 2);
}

TEST_CASE("degenerate and duplicate faces are found exactly") {
  CHECK(inspect(with_triangles(cube(), {{0, 0, 1}, {3, 3, 3}})).degenerate_faces == 2);
  CHECK(inspect(with_triangles(cube(), {{3, 2, 0}, {2, 3, 0}, {0, 1, 2}})).duplicate_faces == 2);
  Points needle(3, 3);
  needle << 0, 0, 0, 1, 1, 1, 3, 3, 3;
  const Triangles one = (Triangles(1, 3) << 0, 1, 2).finished();
  CHECK(inspect(make_shape(needle, one)).degenerate_faces == 1);
  needle(2, 2) = std::nextafter(3.0, 4.0);
  CHECK(inspect(make_shape(needle, one)).degenerate_faces == 0);
}

TEST_CASE("vertices that no triangle uses are counted and do not widen the box") {
  Points vertices = cube().vertices;
  vertices.conservativeResize(10, 3);
  vertices.bottomRows(2) << 9, 9, 9, 0, 0, 0;
  const Findings findings = inspect(make_shape(vertices, cube().triangles));
  CHECK(findings.unreferenced_vertices == 2);
  CHECK(findings.distinct_points == 8);
  CHECK(findings.upper == Eigen::Vector3d(1, 1, 1));
}

TEST_CASE("self-intersections are pairs that meet elsewhere than in what they share") {
  CHECK(self_intersections(concatenate(cube(), solids::moved(cube(), {3, 0, 0}))) == 0);
  // A needle pierces the bottom and the top face away from their diagonals: three sides, the point inside.
  Points vertices(6, 3);
  vertices << 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, -1, 1.25, 1, 1, 1, 1.25, 1;
  const Triangles two = (Triangles(2, 3) << 0, 1, 2, 3, 4, 5).finished();
  CHECK(self_intersections(make_shape(vertices, two)) == 1);
  vertices.bottomRows(3).rowwise() += Eigen::RowVector3d(0, 0, 1);  // its tip touches
  CHECK(self_intersections(make_shape(vertices, two)) == 1);
  vertices(3, 2) = 0x1p-60;
  CHECK(self_intersections(make_shape(vertices, two)) == 0);
  // Two triangles on an edge: folded flat onto each other they overlap, unfolded and bent they do not.
  for (const auto& [y, z, expected] :
       {std::tuple(1.0, 0.0, 1), std::tuple(-1.0, 0.0, 0), std::tuple(1.0, 0.5, 0)}) {
    Points hinge(4, 3);
    hinge << 0, 0, 0, 1, 0, 0, 0, 2, 0, 0.25, y, z;
    CHECK(self_intersections(make_shape(hinge, (Triangles(2, 3) << 0, 1, 2, 1, 0, 3).finished())) ==
          expected);
  }
  // Two triangles on a corner: one passes through the other or not.
  for (const auto& [z, expected] : {std::pair(-1.0, 1), std::pair(0.5, 0)}) {
    Points corner(5, 3);
    corner << 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 1, 1, 1.5, z;
    CHECK(self_intersections(make_shape(corner, (Triangles(2, 3) << 0, 1, 2, 0, 3, 4).finished())) ==
          expected);
  }
}

TEST_CASE("triangles in one place intersect as often as they are there, for the work of one") {
  const Shape crossing = concatenate(cube(), solids::moved(cube(), {0.25, 0.375, 0.5}));
  const std::int64_t once = self_intersections(crossing);
  REQUIRE(once > 0);
  Points vertices(1000 * crossing.vertex_count(), 3);
  Triangles triangles(1000 * crossing.triangle_count(), 3);
  for (Eigen::Index k = 0; k < 1000; ++k) {  // a million times as many pairs: seconds each, tested one by one
    const Eigen::Index v = crossing.vertex_count(), t = crossing.triangle_count();
    vertices.middleRows(k * v, v) = crossing.vertices;
    triangles.middleRows(k * t, t) = crossing.triangles.array() + static_cast<std::int32_t>(k * v);
  }
  CHECK(self_intersections(make_shape(vertices, triangles)) == 1000000 * once);
}

TEST_CASE("the up axis is the one with the widest stand") {
  // A tripod: a small top over three feet, so that it stands well on its low z end only.
  Points vertices(4, 3);
  vertices << 0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0.5, 0.4, 3;
  const Shape tripod =
      make_shape(vertices, (Triangles(4, 3) << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3).finished());
  REQUIRE(inspect(tripod).likely_up.has_value());
  CHECK(*inspect(tripod).likely_up == Axis::z);
  Eigen::Matrix3d z_to_y;
  z_to_y << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  CHECK(*inspect(transformed(tripod, z_to_y, Eigen::Vector3d::Zero())).likely_up == Axis::y);
}

TEST_CASE("a size that objects do not have raises the question of the unit") {
  const auto likely = [](double size, Unit unit) {
    Shape shape = cube(size);
    shape.unit = unit;
    return inspect(shape).likely_unit;
  };
  // Files of metres, read as millimetres, and the other way round.
  CHECK(likely(0.099, Unit::millimetre) == Unit::metre);
  CHECK(likely(900, Unit::metre) == Unit::millimetre);
  CHECK(likely(2, Unit::millimetre) == Unit::metre);
  CHECK(likely(3000, Unit::foot) == Unit::millimetre);
  // The ends of what counts as an object, in two units.
  CHECK_FALSE(likely(4, Unit::millimetre));
  CHECK(likely(3.99, Unit::millimetre) == Unit::metre);
  CHECK_FALSE(likely(50, Unit::metre));
  CHECK(likely(50.1, Unit::metre) == Unit::millimetre);
  // Sizes of objects, and what no unit mends.
  for (const Unit unit : {Unit::inch, Unit::centimetre, Unit::metre}) CHECK_FALSE(likely(30, unit));
  CHECK_FALSE(likely(0.099, Unit::unknown));
  CHECK_FALSE(likely(1e-30, Unit::metre));
  CHECK_FALSE(likely(1e30, Unit::metre));
  Shape shape = cube(0.099);
  shape.unit = Unit::millimetre;
  CHECK(brief(inspect(shape)).ends_with("closed, an unlikely size: are these numbers m?"));
  shape.unit = Unit::metre;
  CHECK(brief(inspect(shape)).ends_with("closed"));
}

TEST_CASE("findings do not depend on the order of the faces, and reports name what was found") {
  Shape shape = with_triangles(cube(), {{0, 1, 7}, {0, 0, 1}, {0, 2, 3}});
  shape.unit = Unit::millimetre;
  Shape reversed = shape;
  reversed.triangles = shape.triangles.colwise().reverse().eval();
  const Findings a = inspect(shape, {InspectOptions::SelfIntersections::count});
  const Findings b = inspect(reversed, {InspectOptions::SelfIntersections::count});
  CHECK(report(a) == report(b));
  CHECK(brief(a).find("1 x 1 x 1 mm") != std::string::npos);
  CHECK(brief(a).find("1 degenerate face, 1 duplicate face") != std::string::npos);
  CHECK(report(a).find("duplicate faces         1\n") != std::string::npos);
}

TEST_CASE("extreme coordinates give no NaN") {
  for (const double scale : {1e-60, 1e-30, 1e30, 1e60}) {
    const Findings findings = inspect(cube(scale));
    CHECK(report(findings).find("nan") == std::string::npos);
    REQUIRE(findings.volume);
    CHECK(*findings.volume > 0);
    CHECK(std::isfinite(*findings.volume));
  }
}
