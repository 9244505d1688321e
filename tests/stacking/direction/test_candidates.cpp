#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "stacking/direction/candidates.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

using Lines = std::vector<Eigen::Vector3d>;

Lines joined(const CandidateDirections& candidates) {
  Lines all = candidates.main;
  all.insert(all.end(), candidates.others.begin(), candidates.others.end());
  return all;
}

bool holds(const Lines& lines, const Eigen::Vector3d& vector) {
  const Eigen::Vector3d unit = vector.normalized();
  return std::any_of(lines.begin(), lines.end(),
                     [&](const Eigen::Vector3d& line) { return line.cross(unit).norm() < 1e-7; });
}

CandidateDirections candidates_of(const Shape& shape) {
  return candidate_directions(StackabilitySolver(shape));
}

}  // namespace

TEST_CASE("candidates are unit vectors, the file's axes first, and no line comes twice") {
  for (const Shape& shape :
       {solids::box({1, 2, 3}), solids::frustum_shell({.segments = 12}), solids::triangle_soup({.seed = 5}),
        transformed(solids::l_shape(4, 1), solids::random_rotation(2), Eigen::Vector3d::Ones())}) {
    const CandidateDirections candidates = candidates_of(shape);
    REQUIRE(candidates.main.size() >= 3);
    for (int k = 0; k < 3; ++k) CHECK(candidates.main[k] == Eigen::Vector3d(Eigen::Vector3d::Unit(k)));
    const Lines all = joined(candidates);
    for (std::size_t i = 0; i < all.size(); ++i) {
      CHECK(all[i].norm() == Approx(1).epsilon(1e-14));
      for (std::size_t j = 0; j < i; ++j) CHECK(all[i].cross(all[j]).norm() >= 1e-9);
    }
  }
}

TEST_CASE("of an upright box all axes are the file's") {
  const CandidateDirections candidates = candidates_of(solids::box({1, 2, 3}));
  CHECK(candidates.main.size() == 3);
  CHECK(candidates.others.empty());
}

TEST_CASE("the axes of a turned shape are candidates") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Eigen::Matrix3d rotation = solids::random_rotation(seed);
    for (const Shape& shape :
         {solids::box({1, 2, 3}), solids::hook({}), solids::frustum_shell({.segments = 12})}) {
      const CandidateDirections candidates =
          candidates_of(transformed(shape, rotation, Eigen::Vector3d(3, 2, 1)));
      CHECK(holds(candidates.main, rotation.col(2)));
    }
  }
}

TEST_CASE("the faces and edges of a tetrahedron are candidates") {
  const std::array<Eigen::Vector3d, 4> corners{{{0, 0, 0}, {4, 0, 1}, {0.5, 3, 1}, {1, 1, 4}}};
  const Lines all = joined(candidates_of(solids::tetrahedron(corners)));
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      CHECK(holds(all, corners[i] - corners[j]));
      for (std::size_t k = 0; k < j; ++k)
        CHECK(holds(all, (corners[j] - corners[i]).cross(corners[k] - corners[i])));
    }
}

TEST_CASE("the directions that most of an inner surface faces are candidates") {
  // Inside the hull, which is a box: a slanted plate.
  const Eigen::Matrix3d tilt =
      Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 0).normalized()).toRotationMatrix();
  const Shape plate = transformed(solids::box({-2, -2, -0.1}, {2, 2, 0.1}), tilt, Eigen::Vector3d(5, 5, 5));
  const Lines all = joined(candidates_of(concatenate(solids::box({10, 10, 10}), plate)));
  CHECK(holds(all, tilt.col(2)));
}

TEST_CASE("main candidates belong to the surface, not to its triangles") {
  const Shape shape = solids::triangle_soup({.seed = 6, .count = 20, .size = 1});
  const Lines coarse = candidates_of(shape).main, fine = candidates_of(solids::subdivided(shape)).main;
  REQUIRE(coarse.size() == 9);
  CHECK(fine.size() == 9);
  for (const Eigen::Vector3d& line : coarse) CHECK(holds(fine, line));
}
