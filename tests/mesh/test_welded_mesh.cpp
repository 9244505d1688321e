#include <set>

#include "mesh/welded_mesh.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using detail::connected_components;
using detail::weld;
using detail::Weld;
using detail::WeldedMesh;

namespace {

/// The same triangles, each with three vertices of its own.
Shape with_repeated_vertices(const Shape& shape) {
  Shape soup = shape;
  soup.vertices.resize(3 * shape.triangle_count(), 3);
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) {
      soup.vertices.row(3 * t + k) = shape.corner(t, k).transpose();
      soup.triangles(t, k) = static_cast<std::int32_t>(3 * t + k);
    }
  return soup;
}

}  // namespace

TEST_CASE("welding brings back the vertices of a soup and keeps every corner where it is") {
  for (const Shape& shape :
       {solids::box({1, 2, 3}), solids::cylinder(1, 2, 12), solids::boxes_sharing_wall()}) {
    const Shape soup = with_repeated_vertices(shape);
    const WeldedMesh mesh = weld(soup);
    std::set<std::array<double, 3>> places;
    for (Eigen::Index v = 0; v < shape.vertex_count(); ++v)
      places.insert({shape.vertices(v, 0), shape.vertices(v, 1), shape.vertices(v, 2)});
    REQUIRE(mesh.points.rows() == static_cast<Eigen::Index>(places.size()));
    for (Eigen::Index t = 0; t < soup.triangle_count(); ++t)
      for (int k = 0; k < 3; ++k) {
        REQUIRE(mesh.points.row(mesh.triangles(t, k)) == soup.corner(t, k).transpose());
        REQUIRE(mesh.of_vertex[static_cast<std::size_t>(soup.triangles(t, k))] == mesh.triangles(t, k));
      }
    for (Eigen::Index p = 0; p < mesh.points.rows(); ++p) {
      const std::int32_t first = mesh.first_vertex[static_cast<std::size_t>(p)];
      CHECK(mesh.of_vertex[static_cast<std::size_t>(first)] == p);
    }
  }
}

TEST_CASE("zero and negative zero are one coordinate, and what no triangle uses is nowhere") {
  Points points(5, 3);
  points << 0, 0, 0, 1, 0, 0, 0, 1, 0, -0.0, 0, -0.0, 7, 7, 7;
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 3, 2, 1;
  const WeldedMesh mesh = weld(make_shape(points, triangles));
  CHECK(mesh.points.rows() == 3);
  CHECK(mesh.triangles.row(1) == Eigen::RowVector3i(0, 2, 1));
  CHECK(mesh.of_vertex == std::vector<std::int32_t>{0, 1, 2, 0, -1});
  CHECK(mesh.area(0) == 0.5);
}

TEST_CASE("parts in one place stay apart when vertices are welded within parts only") {
  const Shape two = concatenate(solids::box({1, 1, 1}), solids::box({1, 1, 1}));
  CHECK(weld(two).points.rows() == 8);
  const WeldedMesh apart = weld(two, Weld::within_parts);
  CHECK(apart.points.rows() == 16);
  for (Eigen::Index t = 0; t < two.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k)
      CHECK(apart.points.row(apart.triangles(t, k)) == two.corner(t, k).transpose());
}

TEST_CASE("a vertex that two parts use is a point of each when vertices are welded within parts only") {
  // Two triangles over one edge, without a repeated vertex.
  Points points(4, 3);
  points << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0;
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 1, 3, 2;
  Shape two = make_shape(points, triangles);
  two.part_names = {"near", "far"};
  two.triangle_part = {0, 1};
  CHECK(weld(two).points.rows() == 4);
  const WeldedMesh apart = weld(two, Weld::within_parts);
  REQUIRE(apart.points.rows() == 6);
  CHECK(apart.triangles.row(0) == Eigen::RowVector3i(0, 1, 2));
  CHECK(apart.triangles.row(1) == Eigen::RowVector3i(3, 4, 5));
  for (Eigen::Index t = 0; t < 2; ++t)
    for (int k = 0; k < 3; ++k)
      CHECK(apart.points.row(apart.triangles(t, k)) == two.corner(t, k).transpose());
}

TEST_CASE("components hang together by points, numbered by their first triangles") {
  const Shape apart = concatenate(solids::box({1, 1, 1}), solids::box({2, 2, 2}, {3, 3, 3}));
  const std::vector<std::int32_t> two = connected_components(weld(apart));
  for (std::size_t t = 0; t < two.size(); ++t) CHECK(two[t] == (t < 12 ? 0 : 1));
  // They meet in the point (1, 1, 1).
  const Shape touching = concatenate(solids::box({1, 1, 1}), solids::box({1, 1, 1}, {3, 3, 3}));
  for (const std::int32_t c : connected_components(weld(touching))) CHECK(c == 0);
}

TEST_CASE("a copy is a triangle with the corners of an earlier one, in any order") {
  Points points(5, 3);
  points << 0, 0, 0, 1, 0, 0, 0, 1, 0, -0.0, 0, 0, 0, 0, 1;
  Triangles triangles(5, 3);
  triangles << 0, 1, 2, 2, 1, 4, 2, 1, 3, 0, 1, 4, 1, 2, 0;
  CHECK(weld(make_shape(points, triangles)).first_copies() == std::vector<std::int32_t>{0, 1, 0, 3, 0});
}
