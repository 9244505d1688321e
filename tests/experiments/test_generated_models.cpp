#include "common/generated_models.h"
#include "stackabilization/io/inspect.h"
#include "support/catch.h"

using namespace stackabilization;
using namespace stackabilization::experiments;

TEST_CASE("boxes of a generated model are closed parts of twelve triangles") {
  for (Shape (*const make)(int) : {rack, cube_grid, coincident_cubes})
    for (const int count : {2, 9, 100}) {
      const Shape shape = make(count);
      CHECK(shape.part_count() == count);
      CHECK(shape.triangle_count() == 12 * count);
      const Findings findings = inspect(shape);
      CHECK(findings.degenerate_faces == 0);
      CHECK(findings.boundary_edges == 0);
    }
}

TEST_CASE("a grid of cubes fills its box where its count is a cube, and stands on its lowest layer") {
  const Shape full = cube_grid(27), partial = cube_grid(20);
  for (int axis = 0; axis < 3; ++axis) CHECK(range_along(full, Eigen::Vector3d::Unit(axis)).length() == 3);
  CHECK(inspect(full).volume.value_or(0) == Approx(27));
  CHECK(range_along(partial, {0, 0, 1}).length() == 3);
  CHECK(range_along(cube_grid(9), {0, 0, 1}).length() == 1);
}

TEST_CASE("coincident cubes are one cube many times") {
  const Shape shape = coincident_cubes(5);
  CHECK(inspect(shape).distinct_points == 8);
  CHECK(inspect(shape).duplicate_faces == 4 * 12);
}

TEST_CASE("a wavy cup is closed and has about as many triangles as asked for") {
  for (const int triangles : {1000, 4096, 20000}) {
    const Shape cup = wavy_cup(triangles);
    CHECK(static_cast<double>(cup.triangle_count()) == Approx(triangles).epsilon(0.05));
    const Findings findings = inspect(cup);
    CHECK(findings.closed);
    CHECK(findings.boundary_edges == 0);
  }
}

TEST_CASE("sheets have about as many triangles as asked for, and borders") {
  for (const int triangles : {1000, 4096, 20000})
    for (Shape (*const make)(int) : {bumpy_bowl, oval_tube}) {
      const Shape sheet = make(triangles);
      CHECK(static_cast<double>(sheet.triangle_count()) == Approx(triangles).epsilon(0.05));
      const Findings findings = inspect(sheet);
      CHECK_FALSE(findings.closed);
      CHECK(findings.boundary_edges > 0);
      CHECK(findings.degenerate_faces == 0);
    }
}
