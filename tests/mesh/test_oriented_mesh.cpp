#include "mesh/edge_table.h"
#include "mesh/oriented_mesh.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using detail::EdgeTable;
using detail::orient;
using detail::OrientedMesh;
using detail::weld;

namespace {

/// Every triangle has the corners of its source, at most two triangles share an edge, and those two agree.
void check_oriented(const Shape& shape, const OrientedMesh& mesh) {
  REQUIRE(mesh.triangles.rows() == static_cast<Eigen::Index>(mesh.source.size()));
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    Eigen::Vector3d ours = Eigen::Vector3d::Zero(), theirs = ours;
    for (int k = 0; k < 3; ++k) {
      ours += mesh.points.row(mesh.triangles(t, k)).transpose();
      theirs += shape.corner(mesh.source[static_cast<std::size_t>(t)], k);
    }
    CHECK((ours - theirs).norm() == Approx(0).margin(1e-12));
  }
  const EdgeTable edges(mesh.triangles);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    REQUIRE(edges[e].size() <= 2);
    if (edges[e].size() == 2) CHECK(edges[e][0].forward != edges[e][1].forward);
  }
}

}  // namespace

TEST_CASE("a soup of flipped triangles with repeated vertices becomes one oriented closed surface") {
  const Shape box = solids::box({1, 1, 1});
  Points points(36, 3);
  Triangles triangles(12, 3);
  for (int t = 0; t < 12; ++t)
    for (int k = 0; k < 3; ++k) {
      points.row(3 * t + k) = box.corner(t, t % 3 == 0 ? 2 - k : k);
      triangles(t, k) = 3 * t + k;
    }
  const Shape soup = make_shape(points, triangles);
  const OrientedMesh mesh = orient(weld(soup));
  check_oriented(soup, mesh);
  CHECK(mesh.points.rows() == 8);
  const EdgeTable edges(mesh.triangles);
  CHECK(edges.size() == 18);  // Euler: 8 - 18 + 12 = 2
  CHECK(edges.sides().size() == 36);
}

TEST_CASE("three sheets on one edge are cut apart, no triangle lost but the one without three corners") {
  Points points(5, 3);
  points << 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, -1, -1, 0;
  Triangles triangles(4, 3);
  triangles << 0, 1, 2, 0, 1, 3, 0, 1, 4, 0, 0, 1;
  const Shape fins = make_shape(points, triangles);
  const OrientedMesh mesh = orient(weld(fins));
  check_oriented(fins, mesh);
  CHECK(mesh.source == std::vector<std::int32_t>{0, 1, 2});
}

TEST_CASE("two cones that share their apex get one apex each") {
  Points points(7, 3);
  points << 0, 0, 0, 1, 0, 1, 0, 1, 1, -1, -1, 1, 1, 0, -1, 0, 1, -1, -1, -1, -1;
  Triangles triangles(6, 3);
  triangles << 0, 1, 2, 0, 2, 3, 0, 3, 1, 0, 5, 4, 0, 6, 5, 0, 4, 6;
  const Shape cones = make_shape(points, triangles);
  const OrientedMesh mesh = orient(weld(cones));
  check_oriented(cones, mesh);
  CHECK(mesh.points.rows() == 8);
}
