#include <limits>

#include "deformation/model/vertex_constraints.h"
#include "stackabilization/core/errors.h"
#include "support/catch.h"
#include "support/differences.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

using Rows = std::vector<std::int32_t>;

/// Parts "top" and "leg_1" to "leg_4".
const Shape& table() {
  static const Shape shape = solids::table({});
  return shape;
}

Points stretched(const Points& vertices, double factor, double up) {
  Points out = vertices;
  out.col(2) = (factor * vertices.col(2)).array() + up;
  return out;
}

}  // namespace

TEST_CASE("without an edit or a constraint, vertices stay to the bit") {
  DeformationConstraints constraints;
  constraints.keep_extent = Direction(0.3, -0.2, 1);
  constraints.box_tolerance = 0;
  constraints.fixed_parts = {1};
  const Rows fixed = fixed_vertices(table(), constraints);
  const MovedVertices same = constrain(table(), table().vertices, constraints, fixed);
  CHECK_FALSE(same.refusal);
  CHECK(same.vertices == table().vertices);
  const Points moved = stretched(table().vertices, 1.5, 3);
  CHECK(constrain(table(), moved, {}, {}).vertices == moved);
}

TEST_CASE("a moved shape has kept its extent") {
  DeformationConstraints constraints;
  constraints.keep_extent = Direction(0, 0, 1);
  const Points moved = stretched(table().vertices, 1, 0.7);
  CHECK(largest_difference(constrain(table(), moved, constraints, {}).vertices, moved) < 1e-14);
}

TEST_CASE("the extent is restored from the end that did not move") {
  DeformationConstraints constraints;
  constraints.keep_extent = Direction(0, 0, 1);
  const Points& rest = table().vertices;  // from 0 to 6
  CHECK(largest_difference(constrain(table(), stretched(rest, 1.5, 0), constraints, {}).vertices, rest) <
        1e-14);
  CHECK(largest_difference(constrain(table(), stretched(rest, 0.5, 3), constraints, {}).vertices, rest) <
        1e-14);
  // Grown by one at both ends: rest lies between them.
  CHECK(largest_difference(constrain(table(), stretched(rest, 8.0 / 6, -1), constraints, {}).vertices, rest) <
        1e-14);
  // Moved by two, then one more at the top: it keeps the bottom where it is now, which is nearest.
  const Points both = stretched(rest, 7.0 / 6, 2);
  CHECK(largest_difference(constrain(table(), both, constraints, {}).vertices, stretched(rest, 1, 2)) <
        1e-14);
}

TEST_CASE("the extent is restored along any direction, after any deformation") {
  solids::Random random(7);
  const Shape shape = solids::sphere(2, 2);
  for (int k = 0; k < 100; ++k) {
    DeformationConstraints constraints;
    const Direction r(3 * random.on_sphere());
    constraints.keep_extent = r;
    Shape moved = shape;
    for (Eigen::Index v = 0; v < moved.vertex_count(); ++v)
      moved.vertices.row(v) += random.in_cube().transpose();
    const MovedVertices result = constrain(shape, moved.vertices, constraints, {});
    REQUIRE_FALSE(result.refusal);
    // Nothing goes across r.
    const Points by = result.vertices - moved.vertices;
    CHECK((by - by * r.unit() * r.unit().transpose()).cwiseAbs().maxCoeff() < 1e-14);
    moved.vertices = result.vertices;
    const double h = range_along(shape, r.unit()).length();
    CHECK(std::abs(range_along(moved, r.unit()).length() - h) < 1e-12 * h);
  }
}

TEST_CASE("fixed vertices keep their place while the extent is restored around them") {
  DeformationConstraints constraints;
  constraints.keep_extent = Direction(0, 0, 1);
  constraints.fixed_points = {{1, 1, 0}, {0, 1, 0}};
  const Rows fixed = fixed_vertices(table(), constraints);
  Points vertices = table().vertices;
  for (Eigen::Index v = 0; v < vertices.rows(); ++v)
    if (vertices(v, 2) > 0) vertices(v, 2) += 2;
  const MovedVertices result = constrain(table(), vertices, constraints, fixed);
  REQUIRE_FALSE(result.refusal);
  CHECK(result.vertices(Eigen::all, 2).maxCoeff() == Approx(6).epsilon(1e-14));
  for (const std::int32_t v : fixed) CHECK(result.vertices.row(v) == table().vertices.row(v));

  // Now the feet go through the ground that is fixed at one corner.
  for (Eigen::Index v = 0; v < vertices.rows(); ++v)
    vertices(v, 2) = table().vertices(v, 2) == 0 ? -1 : table().vertices(v, 2);
  for (const std::int32_t v : fixed) vertices.row(v) = table().vertices.row(v);
  const MovedVertices below = constrain(table(), vertices, constraints, fixed);
  REQUIRE(below.refusal);
  CHECK(below.vertices == table().vertices);
  CHECK(below.refusal->cause == RefusalCause::fixed_low);
  CHECK(below.refusal->amount == Approx(1 / std::sqrt(64 + 64 + 36)));
}

TEST_CASE("what moves a fixed vertex is refused") {
  DeformationConstraints constraints;
  constraints.fixed_parts = {2};
  const Rows fixed = fixed_vertices(table(), constraints);
  CHECK(fixed.size() == 9);  // eight corners, one of them repeated in the top
  Points vertices = table().vertices;
  vertices(fixed[3], 0) += 1e-6;
  const MovedVertices result = constrain(table(), vertices, constraints, fixed);
  REQUIRE(result.refusal);
  CHECK(result.refusal->cause == RefusalCause::fixed_vertex);
  CHECK(result.refusal->index == fixed[3]);
}

TEST_CASE("the box may change by its tolerance and no more") {
  DeformationConstraints constraints;
  constraints.box_tolerance = 0.1;
  CHECK_FALSE(constrain(table(), stretched(table().vertices, 1.1, 5), constraints, {}).refusal);
  CHECK_FALSE(constrain(table(), stretched(table().vertices, 0.9, 5), constraints, {}).refusal);
  const MovedVertices result = constrain(table(), stretched(table().vertices, 1.11, 0), constraints, {});
  REQUIRE(result.refusal);
  CHECK(result.refusal->cause == RefusalCause::box_side);
  CHECK(result.refusal->index == 2);
  constraints.box_tolerance = -1;
  CHECK_THROWS_AS(constrain(table(), table().vertices, constraints, {}), UsageError);
}

TEST_CASE("a fixed point fixes what carries it, and its twins") {
  // Two triangles side by side that repeat the corners of their common edge.
  Points vertices(6, 3);
  vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 3, 4, 5;
  const Shape square = make_shape(vertices, triangles);
  DeformationConstraints constraints;
  constraints.fixed_points = {{-1, -1, 3}};
  CHECK(fixed_vertices(square, constraints) == Rows{0});
  constraints.fixed_points = {{0.5, -2, 0}};
  CHECK(fixed_vertices(square, constraints) == Rows{0, 1, 3});
  constraints.fixed_points = {{0.2, 0.2, 0.1}};
  CHECK(fixed_vertices(square, constraints) == Rows{0, 1, 2, 3, 5});
  constraints.fixed_points = {Eigen::Vector3d::Constant(std::nan(""))};
  CHECK_THROWS_AS(fixed_vertices(square, constraints), UsageError);
  constraints = {};
  constraints.fixed_parts = {1};
  CHECK_THROWS_AS(fixed_vertices(square, constraints), UsageError);
  CHECK(fixed_vertices(square, {}).empty());
}

TEST_CASE("numbers that are not finite and shapes that were flattened are refused") {
  Points vertices = table().vertices;
  vertices(4, 1) = std::numeric_limits<double>::infinity();
  const MovedVertices infinite = constrain(table(), vertices, {}, {});
  REQUIRE(infinite.refusal);
  CHECK(infinite.refusal->cause == RefusalCause::vertex_range);
  CHECK(infinite.refusal->index == 4);
  DeformationConstraints constraints;
  constraints.keep_extent = Direction(0, 0, 1);
  const MovedVertices flat = constrain(table(), stretched(table().vertices, 0, 0), constraints, {});
  REQUIRE(flat.refusal);
  CHECK(flat.refusal->cause == RefusalCause::flat_extent);
}
