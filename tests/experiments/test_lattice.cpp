#include <algorithm>

#include "common/lattice.h"
#include "support/catch.h"

using namespace stackabilization;
using namespace stackabilization::experiments;

namespace {

/// Greatest angle, in radians, from one of many directions of the hemisphere to the nearest of `directions`
/// or its opposite.
double covering_radius(const std::vector<Direction>& directions) {
  double least = 1;
  for (const Direction& probe : random_directions(2000, 99)) {
    double nearest = 0;
    for (const Direction& r : directions)
      nearest = std::max(nearest, std::abs(r.vector().dot(probe.vector())));
    least = std::min(least, nearest);
  }
  return std::acos(std::min(1.0, least));
}

}  // namespace

TEST_CASE("the lattice covers the hemisphere about as evenly as can be") {
  for (const int count : {100, 1000}) {
    const auto lattice = hemisphere_lattice(count);
    REQUIRE(lattice.size() == static_cast<std::size_t>(count));
    for (const Direction& r : lattice) {
      CHECK(r.length() == Approx(1).epsilon(1e-14));
      CHECK(r.vector().z() > 0);
    }
    // Circles of this radius about the directions have the area of the hemisphere together.
    const double bound = std::acos(1 - 1.0 / count);
    CHECK(covering_radius(lattice) > bound);
    CHECK(covering_radius(lattice) < 1.5 * bound);
  }
}

TEST_CASE("random directions are uniform, and the same for the same seed") {
  const auto many = random_directions(20000, 5);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Direction& r : many) {
    CHECK(r.vector().z() > 0);
    mean += r.vector() / 20000;
  }
  CHECK((mean - Eigen::Vector3d(0, 0, 0.5)).norm() < 0.02);  // zones of equal height have equal area
  const auto few = random_directions(10, 5);
  for (std::size_t i = 0; i < few.size(); ++i) CHECK(few[i].vector() == many[i].vector());
  CHECK(random_directions(1, 6)[0].vector() != few[0].vector());
}
