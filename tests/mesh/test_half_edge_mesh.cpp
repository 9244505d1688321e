#include "mesh/half_edge_mesh.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using detail::connected_surface;
using detail::ConnectedSurface;

namespace {

int euler(const detail::HalfEdgeMesh& mesh) {
  return static_cast<int>(mesh.n_vertices()) - static_cast<int>(mesh.n_edges()) +
         static_cast<int>(mesh.n_faces());
}

void check_places(const Shape& shape, const ConnectedSurface& surface) {
  REQUIRE(surface.triangle_of_face.size() == surface.mesh.n_faces());
  REQUIRE(surface.triangle_of_face.size() + surface.degenerate.size() ==
          static_cast<std::size_t>(shape.triangle_count()));
  for (const auto vertex : surface.mesh.vertices()) {
    const auto& p = surface.mesh.point(vertex);
    const auto row = surface.vertex_of[static_cast<std::size_t>(vertex.idx())];
    REQUIRE(row >= 0);
    CHECK(Eigen::RowVector3d(p[0], p[1], p[2]) == shape.vertices.row(row));
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
  const ConnectedSurface surface = connected_surface(soup);
  check_places(soup, surface);
  CHECK(surface.mesh.n_vertices() == 8);
  CHECK(euler(surface.mesh) == 2);
  for (const auto edge : surface.mesh.edges()) CHECK_FALSE(surface.mesh.is_boundary(edge));
}

TEST_CASE("three sheets on one edge are cut apart, no triangle lost") {
  Points points(5, 3);
  points << 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, -1, -1, 0;
  Triangles triangles(4, 3);
  triangles << 0, 1, 2, 0, 1, 3, 0, 1, 4, 0, 0, 1;
  const Shape fins = make_shape(points, triangles);
  const ConnectedSurface surface = connected_surface(fins);
  check_places(fins, surface);
  CHECK(surface.cut_edges == 1);
  CHECK(surface.mesh.n_faces() == 3);
  CHECK(surface.degenerate == std::vector<std::int32_t>{3});
}

TEST_CASE("two cones that share their apex get one apex each") {
  Points points(7, 3);
  points << 0, 0, 0, 1, 0, 1, 0, 1, 1, -1, -1, 1, 1, 0, -1, 0, 1, -1, -1, -1, -1;
  Triangles triangles(6, 3);
  triangles << 0, 1, 2, 0, 2, 3, 0, 3, 1, 0, 5, 4, 0, 6, 5, 0, 4, 6;
  const Shape cones = make_shape(points, triangles);
  const ConnectedSurface surface = connected_surface(cones);
  check_places(cones, surface);
  CHECK(surface.mesh.n_vertices() == 8);
}
