#include <cmath>

#include "deformation/model/hollow.h"
#include "deformation/model/hollow_box.h"
#include "stackabilization/deformation/controller_model.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/structures.h"

using namespace stackabilization;
using namespace stackabilization::detail;

namespace {

/// A crate with a square base and its box, whose sides across the walls lie at 45 degrees to x and y. The
/// draft: by how much half the width of the base is smaller than that of the rim.
StructuredShape square_crate(double draft = 0) {
  solids::FrustumShell walls;
  walls.segments = 4;
  walls.outer_top = 4 * std::sqrt(2), walls.outer_bottom = (4 - draft) * std::sqrt(2);
  walls.inner_top = 3.5 * std::sqrt(2), walls.inner_bottom = (3.5 - draft) * std::sqrt(2);
  walls.height = 6;
  StructuredShape crate{solids::frustum_shell(walls), {}};
  OrientedBox box;
  box.centre = {0, 0, 3};
  box.half_extents = {4, 4, 3};
  box.axes.col(0) = Eigen::Vector3d(1, 1, 0).normalized();
  box.axes.col(1) = Eigen::Vector3d(-1, 1, 0).normalized();
  box.axes.col(2) = Eigen::Vector3d::UnitZ();
  crate.structure.parts = {{crate.shape.part_names.front(), cuboid_of(box), {}}};
  crate.structure.diagonal = 15;
  return crate;
}

const Eigen::Vector3d across = Eigen::Vector3d(1, 1, 0).normalized();

Cuboid hollow_box() {
  const StructuredShape crate = square_crate();
  Cuboid box = std::get<Cuboid>(crate.structure.parts.front().primitive);
  box.inner_sides << 0.75, 0.875, 0.875, 0.875, 1, 1;
  return box;
}

/// Distances of the vertices at the height of the rim along `axis`: half the outer and half the inner width.
std::pair<double, double> rim_widths(const Shape& shape, const Eigen::Vector3d& axis) {
  double outer = 0, inner = 1e300;
  for (Eigen::Index v = 0; v < shape.vertex_count(); ++v) {
    if (shape.vertices(v, 2) < 6 - 1e-9) continue;
    const double distance = std::abs(shape.vertices.row(v).dot(axis));
    outer = std::max(outer, distance);
    inner = std::min(inner, distance);
  }
  return {outer, inner};
}

}  // namespace

TEST_CASE("The walls of a crate are found, solid and open sides have none", "[hollow]") {
  const StructuredShape crate = square_crate();
  const auto& box = std::get<Cuboid>(crate.structure.parts.front().primitive);
  Eigen::Matrix<double, 3, 2> expected;
  expected << 0.875, 0.875, 0.875, 0.875, 1, 1;
  CHECK(inner_sides(crate.shape, box).isApprox(expected, 1e-12));
  // The lowest rays above the floor, 0.5 high, pass 0.6 above the ground.
  const StructuredShape drafted = square_crate(0.8);
  const double lowest = 3.5 - 0.8 * (6 - 0.6) / 5.5;
  expected.topRows<2>().setConstant(lowest / 4);
  CHECK(inner_sides(drafted.shape, box).isApprox(expected, 1e-12));
  CHECK(inner_sides(solids::box({-1, -1, -1}, {1, 1, 1}),
                    cuboid_of({{0, 0, 0}, Eigen::Matrix3d::Identity(), {1, 1, 1}}))
            .isOnes(0));
}

TEST_CASE("Walls of crates keep their thickness in smooth designs, and scale in those of the paper",
          "[hollow]") {
  const Edit wider{{HandleKind::part, 0, -1}, Scale{1.25, across}};
  for (const double draft : {0.0, 0.8}) {
    const ControllerModel smooth(square_crate(draft), {}, Following::smooth), free(square_crate(draft), {});
    const DeformationResult kept = smooth.deformed({wider}, {}), scaled = free.deformed({wider}, {});
    REQUIRE_FALSE(kept.refusal);
    REQUIRE_FALSE(scaled.refusal);
    const auto [outer, inner] = rim_widths(kept.design.shape, across);
    CHECK(outer == Approx(5));
    CHECK(inner == Approx(4.5));
    CHECK(rim_widths(scaled.design.shape, across).second == Approx(3.5 * 1.25));
    const auto [other_outer, other_inner] =
        rim_widths(kept.design.shape, Eigen::Vector3d(-1, 1, 0).normalized());
    CHECK(other_outer == Approx(4));
    CHECK(other_inner == Approx(3.5));
  }
}

TEST_CASE("Points of a hollow box of any size move rigidly with it", "[hollow]") {
  const double size = GENERATE(1.0, 1e-120, 1e120);
  Cuboid box = hollow_box();
  box.corners *= size;
  const HollowBoxAtRest rest(box);
  const Points points = Points::Random(60, 3) * 4 * size;
  const std::vector<HollowBoxBinding> bindings = rest.bind(points);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -0.5).normalized()).toRotationMatrix();
  const Eigen::RowVector3d shift = size * Eigen::RowVector3d(3, -2, 5);
  Cuboid now = box;
  now.corners = (box.corners * turn.transpose()).rowwise() + shift;
  const HollowBoxMotion motion = rest.motion(now);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Eigen::Vector3d expected = turn * points.row(i).transpose() + shift.transpose();
    const Eigen::Vector3d found = rest.position_of(bindings[static_cast<std::size_t>(i)], motion);
    CHECK((found - expected).cwiseAbs().maxCoeff() < 1e-12 * size);
  }
}

TEST_CASE("Points within a wall keep their distance from its outer side, others move in proportion",
          "[hollow]") {
  const Cuboid box = hollow_box();
  const HollowBoxAtRest rest(box);
  // Along the first axis the walls reach from -4 to -3 and from 3.5 to 4; the box gets 2 wider there.
  Points points(5, 3);
  const Eigen::RowVector3d centre(0, 0, 3), first = across.transpose();
  const std::array<double, 5> before = {-4, -3, 0.25, 3.5, 4}, after = {-5, -4, 0.25, 4.5, 5};
  for (Eigen::Index i = 0; i < 5; ++i) points.row(i) = centre + before[static_cast<std::size_t>(i)] * first;
  Cuboid now = box;
  for (Eigen::Index k = 0; k < 8; ++k) now.corners.row(k) += (k & 1 ? 1 : -1) * first;
  const HollowBoxMotion motion = rest.motion(now);
  const std::vector<HollowBoxBinding> bindings = rest.bind(points);
  for (std::size_t i = 0; i < 5; ++i) {
    const Eigen::Vector3d expected = (centre + after[i] * first).transpose();
    CHECK((rest.position_of(bindings[i], motion) - expected).norm() < 1e-12);
  }
}

TEST_CASE("The derivatives of points of a hollow box are those of differences", "[hollow]") {
  const Cuboid box = hollow_box();
  const HollowBoxAtRest rest(box);
  const std::vector<HollowBoxBinding> bindings = rest.bind(Points(Points::Random(20, 3) * 4));
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -1, 2).normalized()).matrix();
  Cuboid now = box;
  now.corners = box.corners * turn.transpose() + Eigen::Matrix<double, 8, 3>::Random() * 0.4;
  const double step = 1e-6;
  for (const HollowBoxBinding& binding : bindings)
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Matrix3d derivative = rest.derivative(binding, rest.motion(now), corner);
      for (int k = 0; k < 3; ++k) {
        Cuboid above = now, below = now;
        above.corners(corner, k) += step;
        below.corners(corner, k) -= step;
        const Eigen::Vector3d difference =
            (rest.position_of(binding, rest.motion(above)) - rest.position_of(binding, rest.motion(below))) /
            (2 * step);
        CHECK((derivative.col(k) - difference).norm() < 1e-7);
      }
    }
}
