#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>
#include <numeric>
#include <random>

#include "mesh/segment_triangle.h"
#include "mesh/triangle_tree.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using detail::TreePoint;

namespace {

using Tree = detail::TriangleTree<CGAL::Simple_cartesian<double>>;

std::vector<std::int32_t> all_rows(const Shape& shape) {
  std::vector<std::int32_t> rows(static_cast<std::size_t>(shape.triangle_count()));
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

Eigen::Vector3d random_point(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> coordinate(-reach, reach);
  return {coordinate(random), coordinate(random), coordinate(random)};
}

}  // namespace

TEST_CASE("the nearest point of the tree is the nearest of all triangles") {
  const Shape shape = solids::cylinder(1, 2, 20);
  const Tree tree(shape, all_rows(shape));
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d p = random_point(random, 3);
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
      least = std::min(
          least,
          (detail::nearest_on_triangle(p, {shape.corner(t, 0), shape.corner(t, 1), shape.corner(t, 2)}) - p)
              .norm());
    const TreePoint found = tree.nearest(p);
    CHECK((found.point - p).norm() == Approx(least).epsilon(1e-12));
  }
}

TEST_CASE("rays from inside of a convex body leave it once, rays from outside meet it twice or never") {
  const Shape box = solids::box({-1, -2, -3}, {1, 2, 3});
  const Tree tree(box, all_rows(box));
  std::mt19937 random(5);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d p = random_point(random, 4), direction = random_point(random, 1);
    const bool inside = (p.cwiseAbs().array() < Eigen::Array3d(1, 2, 3)).all();
    const std::size_t hits = tree.count_hits(p, direction);
    CHECK(tree.is_hit(p, direction) == (hits > 0));
    if (inside)
      CHECK(hits == 1);
    else
      CHECK((hits == 0 || hits == 2));
    const auto hit = tree.first_hit(p, direction);
    REQUIRE(hit.has_value() == (hits > 0));
    if (!hit) continue;
    const Eigen::Array3d depth = hit->point.cwiseAbs().array() - Eigen::Array3d(1, 2, 3);
    CHECK(depth.maxCoeff() == Approx(0).margin(1e-12));
    CHECK((hit->point - p).cross(direction).norm() == Approx(0).margin(1e-12));
  }
}

TEST_CASE("rays meet a shape of any size as they meet it scaled, to the bit") {
  const Shape box = solids::box({-1, -2, -3}, {1, 2, 3});
  const Tree tree(box, all_rows(box));
  for (const int exponent : {-120, -40, 40, 120}) {
    const double scale = std::exp2(exponent);
    Shape scaled = box;
    scaled.vertices *= scale;
    const Tree scaled_tree(scaled, all_rows(scaled));
    std::mt19937 random(7);
    for (int i = 0; i < 50; ++i) {
      const Eigen::Vector3d p = random_point(random, 4), direction = random_point(random, 1).normalized();
      CHECK(scaled_tree.count_hits(scale * p, direction) == tree.count_hits(p, direction));
      CHECK(scaled_tree.is_hit(scale * p, direction) == tree.is_hit(p, direction));
      const auto hit = tree.first_hit(p, direction), scaled_hit = scaled_tree.first_hit(scale * p, direction);
      REQUIRE(scaled_hit.has_value() == hit.has_value());
      if (hit) CHECK(scaled_hit->point == scale * hit->point);
    }
  }
}

TEST_CASE("only the rows that were given are in the tree, under their numbers") {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const Shape box = solids::box({1, 1, 1});
  std::vector<std::int32_t> above;
  for (std::int32_t t = 0; t < box.triangle_count(); ++t)
    if ((box.corner(t, 0) + box.corner(t, 1) + box.corner(t, 2)).z() == 3) above.push_back(t);
  REQUIRE(above.size() == 2);
  const detail::TriangleTree<Kernel> tree(box, above);
  // Through the diagonal of the upper face: both of its triangles.
  std::vector<std::size_t> met;
  tree.append_met(Kernel::Segment_3({0.5, 0.5, 5}, {0.5, 0.5, -5}), met);
  std::sort(met.begin(), met.end());
  CHECK(met == std::vector<std::size_t>{0, 1});
  CHECK(tree.count_met(Kernel::Segment_3({0.5, 0.5, 0.5}, {0.5, 0.5, -5})) == 0);
  CHECK(
      (tree.nearest({0.9, 0.2, 4}).triangle == above[0] || tree.nearest({0.9, 0.2, 4}).triangle == above[1]));
}
