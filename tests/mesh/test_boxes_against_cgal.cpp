#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/optimal_bounding_box.h>

#include <array>
#include <vector>

#include "stackabilization/mesh/boxes.h"
#include "support/catch.h"
#include "support/point_sets.h"

using namespace stackabilization;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

double volume_by_cgal(const Points& points) {
  std::vector<Kernel::Point_3> input;
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    input.emplace_back(points(i, 0), points(i, 1), points(i, 2));
  std::array<Kernel::Point_3, 8> corners;
  CGAL::oriented_bounding_box(input, corners, CGAL::parameters::use_convex_hull(true).random_seed(1));
  const auto side = [&](int i) { return std::sqrt(CGAL::squared_distance(corners[0], corners[i])); };
  return side(1) * side(3) * side(5);
}

}  // namespace

TEST_CASE("never larger than the box of CGAL's evolutionary search") {
  point_sets::Random random(1);
  std::vector<Points> sets = {point_sets::tetrahedron(), point_sets::frustum(5, 1, 0.6, 1),
                              point_sets::frustum(30, 1, 0.8, 2)};
  for (std::uint32_t seed = 0; seed < 30; ++seed)
    sets.push_back(point_sets::in_ball(10 + 20 * static_cast<int>(seed), seed));
  for (const Points& points : sets) {
    const Points turned = point_sets::moved(points, random.rotation(), random.vector(1));
    CHECK(minimal_oriented_box(HullSupport(turned)).volume() <= volume_by_cgal(turned) * (1 + 1e-9));
  }
}
