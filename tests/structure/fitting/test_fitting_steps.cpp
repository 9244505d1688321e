// The steps behind fit_primitive, each against its own closed forms.
#include <cmath>
#include <numbers>
#include <variant>
#include <vector>

#include "stackabilization/structure/fitting.h"
#include "structure/fitting/canonical_pose.h"
#include "structure/fitting/closed_part.h"
#include "structure/fitting/curve_skeleton.h"
#include "structure/fitting/cylinder_sections.h"
#include "structure/fitting/part_box.h"
#include "structure/fitting/revolution_axis.h"
#include "structure/model/fit_error.h"
#include "structure/segmentation/surface_graph.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;
using namespace stackabilization::detail;

namespace {

Skeleton skeleton_of(const Points& points, const std::vector<std::array<int, 2>>& edges) {
  return {points, edges};
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

}  // namespace

TEST_CASE("the distance to a box is that of its faces inside, of its edges and corners outside") {
  const OrientedBox box{{1, 2, 3}, Eigen::Matrix3d::Identity(), {1, 2, 3}};
  CHECK(distance_to_surface(box, Eigen::Vector3d(1, 2, 3)) == Approx(1));
  CHECK(distance_to_surface(box, Eigen::Vector3d(1, 3.5, 3)) == Approx(0.5));
  CHECK(distance_to_surface(box, Eigen::Vector3d(5, 7, 3)) == Approx(std::hypot(3, 3)));
  CHECK(distance_to_surface(box, Eigen::Vector3d(-1, -1, -1)) == Approx(std::sqrt(3)));
  CHECK(distance_to_surface(box, Eigen::Vector3d(2, 2, 3)) == Approx(0).margin(1e-15));
}

TEST_CASE("the distance to a cylinder counts its wall and its ends, a closed one has none") {
  GeneralizedCylinder rod{.centres = Points(3, 3), .radii = Eigen::Vector3d(2, 2, 2)};
  rod.centres << 0, 0, 0, 0, 0, 5, 0, 0, 10;
  CHECK(distance_to_surface(rod, {0, 0, 5}) == Approx(2));
  CHECK(distance_to_surface(rod, {0, 1.5, 5}) == Approx(0.5));
  CHECK(distance_to_surface(rod, {0, 0, 9}) == Approx(1));
  CHECK(distance_to_surface(rod, {1, 0, -3}) == Approx(3));
  CHECK(distance_to_surface(rod, {5, 0, 14}) == Approx(5));
  CHECK(distance_to_surface(rod, {4, 0, 5}) == Approx(2));

  GeneralizedCylinder cone{.centres = Points(2, 3), .radii = Eigen::Vector2d(4, 1)};
  cone.centres << 0, 0, 0, 0, 0, 3;  // its wall falls at 45 degrees: rho + z = 4
  CHECK(distance_to_surface(cone, {5, 0, 1}) == Approx(std::sqrt(2)));

  GeneralizedCylinder ring{
      .centres = Points(64, 3), .radii = Eigen::VectorXd::Constant(64, 0.5), .closed = true};
  for (int k = 0; k < 64; ++k) ring.centres.row(k) << 3 * solids::circle_point(k, 64).transpose(), 0;
  for (int k = 0; k < 128; ++k) {
    const Eigen::Vector2d out = 4 * solids::circle_point(k, 128);
    CHECK(distance_to_surface(ring, {out.x(), out.y(), 0}) == Approx(0.5).epsilon(0.01));
  }
}

TEST_CASE("errors are two-sided, and zero on the surface itself") {
  const Shape box = solids::box({1, 2, 3});
  const FitSurface part(box);
  CHECK(fit_error(axis_aligned_box(box.vertices), part) == Approx(0).margin(1e-12));
  // Two opposite walls lie on the box; all of its other four faces are up to half a unit away from them.
  const Shape walls =
      concatenate(solids::box({0, 0, 0}, {1e-6, 1, 1}), solids::box({1, 0, 0}, {1 + 1e-6, 1, 1}));
  const FitSurface hollow(walls);
  const OrientedBox cube = axis_aligned_box(walls.vertices);
  CHECK(distance_to_surface(cube, hollow) == Approx(0).margin(1e-5));
  // Over a face the mean square of min(x, 1 - x) is 1 / 12, over the six faces 4 / 72; halved for the other
  // side.
  CHECK(fit_error(cube, hollow) == Approx(std::sqrt(4.0 / 72 / 2)).epsilon(0.02));
}

TEST_CASE("the axis of a body of revolution is found in any pose, from few facets, inside and outside") {
  for (const int segments : {8, 11, 64})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      solids::FrustumShell options;
      options.segments = segments;
      const Shape cup = transformed(solids::frustum_shell(options), solids::random_rotation(seed), {5, 6, 7});
      const std::optional<AxisLine> axis = revolution_axis(FitSurface(cup));
      REQUIRE(axis);
      const Eigen::Vector3d expected = solids::random_rotation(seed).col(2);
      CHECK(angle_between(axis->direction, expected) < 1e-7);
      CHECK((axis->point - Eigen::Vector3d(5, 6, 7)).cross(expected).norm() < 1e-6);
    }
}

TEST_CASE("of what is no body of revolution no axis is found") {
  for (const Shape& shape : {solids::box({1, 1, 3}), solids::box({1, 2, 3}), solids::stairs({}),
                             solids::u_shape(5, 1), solids::cylinder(1, 2, 5), solids::table({})})
    CHECK_FALSE(revolution_axis(FitSurface(shape)));
}

TEST_CASE("the stub of a handle does not widen the circles of a cup, the corners of few facets do") {
  const AxisLine axis{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()};
  const auto stubbed = [](double farthest) {
    return concatenate(solids::cylinder(1, 5, 48), solids::box({0.9, -0.2, 2}, {farthest, 0.2, 3}));
  };
  const auto radii = [&](const Shape& shape) {
    return straight_cylinder(shape, axis, 11, SectionRadius::outermost)->radii;
  };
  for (const double farthest : {1.4, 1.03}) CHECK(radii(stubbed(farthest)).isOnes(1e-12));
  for (const int facets : {8, 12, 48}) CHECK(radii(solids::cylinder(1, 5, facets)).isOnes(1e-12));
}

TEST_CASE("the box of a tapered leg stands along the leg, and mirrors with it") {
  const Eigen::Matrix3d splay =
      Eigen::AngleAxisd(0.15, Eigen::Vector3d(1, 2, 0).normalized()).toRotationMatrix();
  const Shape leg =
      transformed(solids::surface_of_revolution({{0, 0}, {0.8, 0}, {1, 15}, {0, 15}}, 4),
                  splay * Eigen::AngleAxisd(std::numbers::pi / 4, Eigen::Vector3d::UnitZ()), {0, 0, 0});
  const PartBox box = part_box(FitSurface(leg));
  CHECK(angle_between(box.box.axes.col(2), splay.col(2)) < 1e-6);
  const Eigen::Matrix3d mirror = Eigen::Vector3d(-1, 1, 1).asDiagonal();
  const PartBox other = part_box(FitSurface(transformed(leg, mirror, {0, 0, 0})));
  CHECK((mirror * box.box.centre - other.box.centre).norm() < 1e-9);
  CHECK((box.box.half_extents - other.box.half_extents).norm() < 1e-9);
  for (int k = 0; k < 3; ++k)
    CHECK(angle_between(mirror * box.box.axes.col(k), other.box.axes.col(k)) < 1e-7);
}

TEST_CASE("axes of equal length keep their order whatever rounding says") {
  OrientedBox box;
  box.half_extents = Eigen::Vector3d(1, 1 + 1e-14, 1 - 1e-14);
  CHECK(axes_by_length(box) == std::array<int, 3>{2, 1, 0});
  box.half_extents = Eigen::Vector3d(2, 1, 3);
  CHECK(axes_by_length(box) == std::array<int, 3>{2, 0, 1});
}

TEST_CASE("copies of a part are equal in their canonical pose, mirrored ones and those in other units too") {
  Shape part = solids::stairs({});
  part.vertices.col(1).array() *= 1 + 0.1 * part.vertices.col(0).array();  // no symmetry left
  const CanonicalPose pose = canonical_pose(part, part_box(FitSurface(part)).box);
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Eigen::Matrix3d linear = solids::random_rotation(seed);
    if (seed % 2 == 0) linear.col(0) *= -1;
    const double unit = std::pow(1000.0, static_cast<double>(seed) - 2);
    Shape copy = transformed(part, unit * linear, {1, -2, 3});
    if (seed % 2 == 0) copy.triangles.col(1).swap(copy.triangles.col(2));  // turned outward again
    const CanonicalPose again = canonical_pose(copy, part_box(FitSurface(copy)).box);
    CHECK((pose.part.vertices - again.part.vertices).norm() == Approx(0).margin(1e-6));
    CHECK(pose.part.triangles == again.part.triangles);
    const Points back = again.to_model(again.part.vertices);
    CHECK((back - copy.vertices).rowwise().norm().maxCoeff() < 1e-6 * again.diagonal);
  }
}

TEST_CASE("the main curve of a tree is its longest path, from the lower end") {
  Points points(6, 3);
  points << 0, 0, 5, 0, 0, 3, 0, 0, 0, 1, 0, 3, 9, 0, 3, 0, 0, -1;
  // A trunk from z = 5 to -1 and a branch to x = 9: the longest path goes from the foot into the branch.
  const std::optional<Curve> curve =
      main_curve(skeleton_of(points, {{0, 1}, {1, 2}, {1, 3}, {3, 4}, {2, 5}}));
  REQUIRE(curve);
  CHECK_FALSE(curve->closed);
  Points expected(5, 3);
  expected << 0, 0, -1, 0, 0, 0, 0, 0, 3, 1, 0, 3, 9, 0, 3;
  CHECK(curve->points == expected);
}

TEST_CASE("a loop with short branches is closed, a short loop on a long path is not") {
  Points points(6, 3);
  points << 0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, -1, 0, 0, -20, 0, 0;
  const std::vector<std::array<int, 2>> square{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}};
  const std::optional<Curve> loop = main_curve(skeleton_of(points, square));
  REQUIRE(loop);
  CHECK(loop->closed);
  CHECK(loop->points.rows() == 4);
  std::vector<std::array<int, 2>> lasso = square;
  lasso.push_back({4, 5});
  const std::optional<Curve> path = main_curve(skeleton_of(points, lasso));
  REQUIRE(path);
  CHECK_FALSE(path->closed);
  CHECK(path->points.row(0) == Eigen::RowVector3d(-20, 0, 0));
  CHECK(path->points.row(path->points.rows() - 1) == Eigen::RowVector3d(2, 2, 0));
  CHECK_FALSE(main_curve(skeleton_of(points, {})));
}

TEST_CASE("a closed part stays what it is, an open one is wrapped closely") {
  const std::optional<ClosedPart> box = closed_part(solids::box({1, 1, 8}));
  REQUIRE(box);
  CHECK_FALSE(box->wrapped);
  CHECK(solids::is_closed(box->surface));
  CHECK(solids::signed_volume(box->surface) == Approx(8).epsilon(0.02));
  CHECK(box->surface.triangle_count() > 1000);
  CHECK(solids::signed_volume(closed_part(solids::flipped(solids::box({1, 1, 8})))->surface) > 0);

  // An open tube gets caps: no lining, which would have half of its volume and a ring for a skeleton.
  const double radius = 1, length = 6;
  const Shape tube = solids::cylinder(radius, length, 64);
  std::vector<std::int32_t> wall;
  for (std::int32_t t = 0; t < tube.triangle_count(); ++t) {
    const Eigen::Vector3d heights(tube.corner(t, 0).z(), tube.corner(t, 1).z(), tube.corner(t, 2).z());
    if (heights.minCoeff() != heights.maxCoeff()) wall.push_back(t);
  }
  const Shape open_tube = extracted(tube, wall);
  const std::optional<ClosedPart> capped = closed_part(open_tube);
  REQUIRE(capped);
  CHECK(capped->wrapped);
  CHECK(solids::is_closed(capped->surface));
  CHECK(solids::signed_volume(capped->surface) ==
        Approx(std::numbers::pi * radius * radius * length).epsilon(0.15));

  const std::optional<ClosedPart> wrapped = closed_part(solids::open_box({4, 4, 2}));
  REQUIRE(wrapped);
  CHECK(wrapped->wrapped);
  CHECK(solids::is_closed(wrapped->surface));
  const double diagonal = 6;
  const Points& points = wrapped->surface.vertices;
  CHECK(points.minCoeff() > -0.02 * diagonal);
  CHECK(points.maxCoeff() < 4 + 0.02 * diagonal);
}

TEST_CASE("a large part is clustered and wrapped") {
  Shape fine = solids::torus({});
  for (int level = 0; level < 3; ++level) fine = solids::subdivided(fine);
  REQUIRE(fine.triangle_count() > 20000);
  const std::optional<ClosedPart> closed = closed_part(fine);
  REQUIRE(closed);
  CHECK(closed->wrapped);
  CHECK(closed->surface.triangle_count() < 10000);
  const std::optional<Skeleton> skeleton = curve_skeleton(closed->surface);
  REQUIRE(skeleton);
  const std::optional<Curve> curve = main_curve(*skeleton);
  REQUIRE(curve);
  CHECK(curve->closed);
  for (const auto& point : curve->points.rowwise()) CHECK(point.head<2>().norm() == Approx(3).epsilon(0.1));
}

TEST_CASE("a curve is moved to the middle of its tube and drawn out to its ends") {
  const Shape rod = transformed(solids::cylinder(1, 10, 32), solids::random_rotation(9), {0, 0, 0});
  const Eigen::Vector3d axis = solids::random_rotation(9).col(2), across = solids::random_rotation(9).col(0);
  Curve curve{Points(3, 3)};
  curve.points << (2 * axis + 0.3 * across).transpose(), (5 * axis - 0.2 * across).transpose(),
      (7 * axis).transpose();
  const std::optional<GeneralizedCylinder> cylinder = curved_cylinder(FitSurface(rod), curve, 12);
  REQUIRE(cylinder);
  for (int i = 0; i < 12; ++i) {
    CHECK(cylinder->radii(i) == Approx(1).epsilon(0.02));
    CHECK(cylinder->centres.row(i).transpose().cross(axis).norm() < 0.02);
  }
  CHECK(cylinder->centres.row(0).dot(axis.transpose()) == Approx(0).margin(0.02));
  CHECK(cylinder->centres.row(11).dot(axis.transpose()) == Approx(10).margin(0.02));
  const Curve nowhere{Points(Points::Constant(2, 3, 1))};
  CHECK_FALSE(curved_cylinder(FitSurface(rod), nowhere, 12));
}

TEST_CASE("loops run counter-clockwise about their upward side, from the side of the first axis on") {
  const Shape rim = solids::torus({});
  const std::optional<GeneralizedCylinder> ring =
      ring_cylinder(FitSurface(rim), {Eigen::Vector3d::Zero(), -Eigen::Vector3d::UnitZ()}, 24);
  REQUIRE(ring);
  Curve backward{Points(40, 3), true};
  for (int k = 0; k < 40; ++k) backward.points.row(k) << 3 * solids::circle_point(57 - k, 40).transpose(), 0;
  const std::optional<GeneralizedCylinder> loop = curved_cylinder(FitSurface(rim), backward, 24);
  REQUIRE(loop);
  CHECK(loop->closed);
  for (int k = 0; k < 24; ++k) {
    const Eigen::Vector2d expected = 3 * solids::circle_point(k, 24);
    CHECK((ring->centres.row(k).head<2>().transpose() - expected).norm() < 1e-9);
    CHECK((loop->centres.row(k).head<2>().transpose() - expected).norm() < 0.05);
    CHECK(loop->radii(k) == Approx(1).epsilon(0.04));
  }
}

TEST_CASE("the middle line of a leaning prism leans with it") {
  // Every horizontal outline is the same square, moved: the middles lie on one line exactly.
  Shape leg = solids::box({1, 1, 10});
  for (auto vertex : leg.vertices.rowwise()) vertex.x() += 0.2 * vertex.z();
  const std::optional<AxisLine> line =
      middle_line(leg, {Eigen::Vector3d(5, -3, 2), -Eigen::Vector3d::UnitZ()}, 12);
  REQUIRE(line);
  CHECK((line->direction - Eigen::Vector3d(0.2, 0, 1).normalized()).norm() == Approx(0).margin(1e-9));
  CHECK((line->point - Eigen::Vector3d(0.5, 0.5, 0)).cross(line->direction).norm() == Approx(0).margin(1e-9));
  const FittedPrimitive fitted = fit_primitive(leg, {.kind = PrimitiveKind::cylinder});
  const auto& cylinder = std::get<GeneralizedCylinder>(fitted.primitive);
  CHECK(section_tangents(cylinder).row(6).dot(line->direction.transpose()) == Approx(1).epsilon(1e-4));
}

TEST_CASE("the slanted end of a rod does not shrink its last circle") {
  Shape rod = solids::cylinder(1, 10, 32);
  for (auto vertex : rod.vertices.rowwise())
    if (vertex.z() > 5) vertex.z() += 0.8 * vertex.x();
  const std::optional<GeneralizedCylinder> cylinder = straight_cylinder(
      rod, {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()}, 12, SectionRadius::outermost);
  REQUIRE(cylinder);
  CHECK(cylinder->radii.minCoeff() == Approx(1).epsilon(1e-6));
  CHECK(cylinder->radii.maxCoeff() == Approx(1).epsilon(1e-6));
}
