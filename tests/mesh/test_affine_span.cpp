#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "mesh/affine_span.h"
#include "mesh/hull_faces.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/mesh/boxes.h"
#include "stackabilization/mesh/convex_hull.h"
#include "support/catch.h"
#include "support/nearly_flat.h"

using namespace stackabilization;
using point_sets::nearly_flat_sets;

namespace {

double max_coordinate(const Points& points) {
  return points.cwiseAbs().maxCoeff();
}

bool is_row_of(const Points& points, const Eigen::RowVector3d& row) {
  return ((points.rowwise() - row).rowwise().lpNorm<Eigen::Infinity>().array() == 0).any();
}

/// How often each side of the triangles runs in each direction.
std::map<std::array<int, 2>, int> sides_of(const Triangles& triangles) {
  std::map<std::array<int, 2>, int> sides;
  for (const auto& t : triangles.rowwise())
    for (int k = 0; k < 3; ++k) ++sides[{t(k), t((k + 1) % 3)}];
  return sides;
}

void check_closed(const TriangulatedHull& hull) {
  const auto sides = sides_of(hull.triangles);
  for (const auto& [side, count] : sides) {
    CHECK(count == 1);
    CHECK(sides.count({side[1], side[0]}) == 1);
  }
  CHECK(hull.points.rows() + hull.triangles.rows() ==
        static_cast<Eigen::Index>(sides.size()) / 2 + 2);  // Euler
}

/// Largest distance of a point above a hull face, as a fraction of the largest coordinate.
double overhang_of_hull(const HullFaces& hull, const Points& points, double unit) {
  double most = 0;
  for (Eigen::Index f = 0; f < hull.normals.rows(); ++f) {
    const Eigen::Vector3d normal = hull.normals.row(f).transpose();
    most = std::max(most, ((points / unit) * normal).maxCoeff() - ((hull.points / unit) * normal).maxCoeff());
  }
  return most;
}

}  // namespace

TEST_CASE("the hull of any set of points has the dimension of its span, exactly") {
  for (const auto& [name, points, dimension] : nearly_flat_sets()) {
    INFO(name);
    const TriangulatedHull hull = triangulated_hull(points);
    REQUIRE(hull.dimension == affine_dimension(points));
    if (dimension >= 0) CHECK(hull.dimension == dimension);
    CHECK(hull.points.rows() >= hull.dimension + 1);
    for (const auto& corner : hull.points.rowwise()) CHECK(is_row_of(points, corner));
    CHECK(affine_dimension(hull.points) == hull.dimension);
    if (hull.dimension < 2) {
      CHECK(hull.points.rows() == hull.dimension + 1);
      CHECK(hull.triangles.rows() == 0);
    } else if (hull.dimension == 2) {
      CHECK(hull.triangles.rows() == hull.points.rows() - 2);
    } else {
      check_closed(hull);
    }
  }
}

TEST_CASE("a flat hull is its polygon, and does not depend on the order of the points") {
  Points points = point_sets::lifted_lattice(0);
  const TriangulatedHull hull = triangulated_hull(points);
  REQUIRE(hull.points.rows() == 4);
  CHECK(hull.points.row(0) == Eigen::RowVector3d(0, 0, 0));
  CHECK(hull.points.row(3) == Eigen::RowVector3d(3, 2, 0));
  const TriangulatedHull reversed = triangulated_hull(points.colwise().reverse());
  CHECK(reversed.points == hull.points);
  CHECK(reversed.triangles == hull.triangles);
  // The plane x + y + z = 6 is seen edge on along no axis, the plane x = y along z.
  Points slanted(5, 3), upright(5, 3);
  slanted << 6, 0, 0, 0, 6, 0, 0, 0, 6, 2, 2, 2, 3, 3, 0;
  upright << 0, 0, 0, 4, 4, 0, 4, 4, 3, 0, 0, 3, 2, 2, 1;
  CHECK(triangulated_hull(slanted).points.rows() == 3);
  CHECK(triangulated_hull(upright).points.rows() == 4);
}

TEST_CASE("what is solid up to a resolution is solid exactly, and thin sets are flat") {
  for (const auto& [name, points, dimension] : nearly_flat_sets()) {
    INFO(name);
    const double unit = max_coordinate(points);
    int before = 3;
    for (const double relative : {0.0, 1e-16, tolerance::rounding, tolerance::relative, 1e-2, 10.0}) {
      const AffineSpan span = affine_span(points, relative * unit);
      CHECK(span.dimension <= affine_dimension(points));
      if (relative > 1e-15) CHECK(span.dimension <= before);
      before = span.dimension;
      if (span.dimension > 0) CHECK(span.axis.norm() == Approx(1));
      if (span.dimension > 1) CHECK(span.normal.norm() == Approx(1));
      if (span.dimension == 2) {
        const Points offsets = (points.rowwise() - span.origin.transpose()) / unit;
        CHECK((offsets * span.normal).cwiseAbs().maxCoeff() <= std::max(relative, 1e-14));
      }
    }
    CHECK(before == 0);
  }
}

TEST_CASE("hull faces, and boxes on them, take sets of any thickness") {
  for (const auto& [name, points, dimension] : nearly_flat_sets()) {
    INFO(name);
    const double unit = max_coordinate(points);
    for (const double relative : {0.0, 1e-16, tolerance::rounding, tolerance::relative, 1e-2}) {
      const HullFaces hull = hull_faces(points, relative * unit);
      REQUIRE(hull.dimension <= affine_dimension(points));
      REQUIRE(hull.points.rows() > hull.dimension);
      CHECK(hull.points.allFinite());
      CHECK((hull.dimension == 3) == (hull.normals.rows() > 3));
      CHECK((hull.dimension == 2) == (hull.normals.rows() == 2));
      // A hull that says it is solid has corners that are: what is built on them may rely on it.
      CHECK((hull.dimension < 3 || triangulated_hull(hull.points).dimension == 3));
      if (relative > 1e-15) CHECK(overhang_of_hull(hull, points, unit) <= 4 * relative);
    }
    const HullSupport support(points);
    const OrientedBox box = minimal_oriented_box(support);
    CHECK(box.half_extents.allFinite());
    CHECK(box.axes.allFinite());
    const Points local = ((points.rowwise() - box.centre.transpose()) / unit) * box.axes;
    for (int k = 0; k < 3; ++k)
      CHECK(local.col(k).cwiseAbs().maxCoeff() <= box.half_extents(k) / unit + 1e-12);
    CHECK((support.dimension() == 3 || box.half_extents.minCoeff() <= 1e-12 * unit));
  }
}

TEST_CASE("sets a thousandth thick are solid, thinner than rounding they are flat") {
  for (const auto& [pose, rotation] : point_sets::poses()) {
    INFO(pose);
    const auto dimension = [&, turn = rotation](double thickness) {
      return HullSupport(point_sets::moved(point_sets::lifted_lattice(thickness), turn, {0, 0, 0}))
          .dimension();
    };
    CHECK(dimension(1e-3) == 3);
    CHECK(dimension(1e-11) == 3);
    CHECK(dimension(1e-14) == 2);
    CHECK(dimension(0) == 2);
  }
}

TEST_CASE("a body whose faces run together to the resolution is flat, whatever its corners are") {
  // Slabs about as thick as the resolution: their faces are joined in many ways, and what is left of their
  // corners may lie in one plane.
  point_sets::Random random(77);
  const double resolution = tolerance::relative;
  for (int k = 0; k < 3000; ++k) {
    Points points = point_sets::in_ball(8, static_cast<std::uint32_t>(1000 + k));
    points.col(2) *= resolution * std::exp2(random.uniform(-2, 6));
    if (k % 2 == 0) points = (points * 0x1p34).array().round() * 0x1p-34;  // many exactly in one plane
    const HullFaces hull = hull_faces(points, resolution);
    REQUIRE((hull.dimension < 3 || triangulated_hull(hull.points).dimension == 3));
  }
}
