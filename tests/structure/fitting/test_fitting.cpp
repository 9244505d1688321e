#include <cmath>
#include <future>
#include <numbers>
#include <variant>

#include "stackabilization/core/errors.h"
#include "stackabilization/structure/fitting.h"
#include "stackabilization/structure/tolerances.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

constexpr double pi = std::numbers::pi;

const GeneralizedCylinder& cylinder_of(const FittedPrimitive& fitted) {
  REQUIRE(std::holds_alternative<GeneralizedCylinder>(fitted.primitive));
  validate(fitted.primitive, "part");
  return std::get<GeneralizedCylinder>(fitted.primitive);
}

const Cuboid& cuboid_in(const FittedPrimitive& fitted) {
  REQUIRE(std::holds_alternative<Cuboid>(fitted.primitive));
  validate(fitted.primitive, "part");
  return std::get<Cuboid>(fitted.primitive);
}

/// Distance of every row of `points` from the line through `point` along `axis`, at most.
double farthest_from_line(const Points& points, const Eigen::Vector3d& point, const Eigen::Vector3d& axis) {
  double farthest = 0;
  for (const auto& row : points.rowwise())
    farthest = std::max(farthest, (row.transpose() - point).cross(axis.normalized()).norm());
  return farthest;
}

double length_of(const GeneralizedCylinder& cylinder) {
  const Eigen::VectorXd reached = section_arc_lengths(cylinder);
  return reached(reached.size() - 1);
}

/// A tube of circles of radius `tube` around an arc of radius `ring` in the plane (x, z), from angle 0,
/// capped.
Shape arc_tube(double ring, double tube, double angle) {
  const int around = 16, along = 64;
  Shape shape;
  shape.vertices.resize(around * (along + 1) + 2, 3);
  for (int i = 0; i <= along; ++i) {
    const double a = angle * i / along;
    const Eigen::Vector3d out(std::cos(a), 0, std::sin(a));
    for (int k = 0; k < around; ++k) {
      const Eigen::Vector2d circle = tube * solids::circle_point(k, around);
      shape.vertices.row(i * around + k) =
          ((ring + circle.x()) * out + circle.y() * Eigen::Vector3d::UnitY()).transpose();
    }
    if (i == 0) shape.vertices.row(around * (along + 1)) = ring * out.transpose();
    if (i == along) shape.vertices.row(around * (along + 1) + 1) = ring * out.transpose();
  }
  std::vector<Eigen::Vector3i> triangles;
  for (int k = 0; k < around; ++k) {
    const int next = (k + 1) % around;
    for (int i = 0; i < along; ++i) {
      const int a = i * around + k, b = i * around + next;
      triangles.emplace_back(a, a + around, b);
      triangles.emplace_back(b, a + around, b + around);
    }
    triangles.emplace_back(around * (along + 1), k, next);
    triangles.emplace_back(around * (along + 1) + 1, around * along + next, around * along + k);
  }
  Triangles rows(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    rows.row(static_cast<Eigen::Index>(t)) = triangles[t].transpose();
  return make_shape(shape.vertices, rows);
}

/// The triangles `keep` says yes to.
template <class Keep>
Shape part_where(const Shape& shape, Keep keep) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    if (keep(t)) rows.push_back(t);
  return make_shape(shape.vertices, Triangles(shape.triangles(rows, Eigen::all)));
}

Shape posed(const Shape& shape, std::uint64_t seed, double scale) {
  return transformed(shape, scale * solids::random_rotation(seed), {3, -7, 11});
}

}  // namespace

TEST_CASE("the cuboid of a box is the box, corner by corner, in any place and size") {
  for (const Eigen::Vector3d& size :
       {Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(8, 8, 0.5), Eigen::Vector3d(2, 2, 2)}) {
    const FittedPrimitive fitted =
        fit_primitive(solids::box({10, 20, 30}, Eigen::Vector3d(10, 20, 30) + size));
    const Cuboid& cuboid = cuboid_in(fitted);
    for (int k = 0; k < 8; ++k)
      for (int a = 0; a < 3; ++a)
        CHECK(cuboid.corners(k, a) == Approx(10 * (a + 1) + ((k >> a) & 1 ? size(a) : 0)).epsilon(1e-14));
    CHECK(fitted.fit.cuboid_error == Approx(0).margin(1e-12));
    REQUIRE(fitted.fit.cylinder_error);
    CHECK(*fitted.fit.cylinder_error > 0.01);
    CHECK(fitted.fit.note.empty());
  }
}

TEST_CASE("the box of a turned box has its corners, and the axes nearest to the file's") {
  const Eigen::Vector3d size(1, 2, 5);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  const FittedPrimitive fitted = fit_primitive(transformed(solids::box(size), 100 * turn, {1, 2, 3}));
  const Cuboid& cuboid = cuboid_in(fitted);
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3d corner((k & 1) * size.x(), ((k >> 1) & 1) * size.y(), ((k >> 2) & 1) * size.z());
    CHECK((cuboid.corners.row(k).transpose() - 100 * turn * corner - Eigen::Vector3d(1, 2, 3)).norm() ==
          Approx(0).margin(1e-9));
  }
  CHECK(fitted.fit.cuboid_error == Approx(0).margin(1e-12));
}

TEST_CASE("round and square parts get boxes along the file's axes, whatever their facets") {
  const auto axes_aligned = [](const Shape& shape) {
    const Cuboid cuboid = cuboid_in(fit_primitive(shape, {.kind = PrimitiveKind::cuboid}));
    const OrientedBox box = axis_aligned_box(shape.vertices);
    return (cuboid.corners - cuboid_of(box).corners).norm() <= 1e-12 * box.half_extents.norm();
  };
  CHECK(axes_aligned(solids::cylinder(2, 0.5, 16)));
  CHECK(axes_aligned(solids::cylinder(1, 9, 64)));
  CHECK(axes_aligned(solids::sphere(1, 2)));
}

TEST_CASE("the radii of a cylinder are those of its corners, along its whole length") {
  const FittedPrimitive fitted = fit_primitive(solids::cylinder(2, 9, 32));
  const GeneralizedCylinder& cylinder = cylinder_of(fitted);
  CHECK_FALSE(cylinder.closed);
  REQUIRE(cylinder.centres.rows() == 24);
  CHECK(farthest_from_line(cylinder.centres, {0, 0, 0}, {0, 0, 1}) < 1e-9);
  CHECK(cylinder.radii.minCoeff() == Approx(2).epsilon(1e-9));
  CHECK(cylinder.radii.maxCoeff() == Approx(2).epsilon(1e-9));
  CHECK(std::abs(cylinder.centres(0, 2) - cylinder.centres(23, 2)) == Approx(9));
  // Flat facets lie at most r (1 - cos(pi / 32)) = 0.01 inside the circle.
  CHECK(*fitted.fit.cylinder_error < 0.01 / 10);
  CHECK(fitted.fit.cuboid_error > 10 * *fitted.fit.cylinder_error);
}

TEST_CASE("the radii of a cone frustum grow evenly") {
  const GeneralizedCylinder cylinder = cylinder_of(fit_primitive(
      solids::surface_of_revolution({{0, 0}, {1, 0}, {2, 6}, {0, 6}}, 24), {.kind = {}, .sections = 7}));
  REQUIRE(cylinder.radii.size() == 7);
  for (int i = 0; i < 7; ++i) {
    const double height = cylinder.centres(i, 2);
    CHECK(cylinder.radii(i) == Approx(1 + height / 6).epsilon(1e-8));
  }
}

TEST_CASE("a leg that leans in its box is followed along its middle") {
  Eigen::Matrix3d lean = Eigen::Matrix3d::Identity();
  lean.col(2) = Eigen::Vector3d(0.1, -0.06, 1);
  const Shape leg =
      transformed(solids::surface_of_revolution({{0, 0}, {2, 0}, {1, 20}, {0, 20}}, 12), lean, {3, 4, 5});
  const GeneralizedCylinder cylinder =
      cylinder_of(fit_primitive(leg, {.kind = PrimitiveKind::cylinder, .sections = 24}));
  CHECK(farthest_from_line(cylinder.centres, {3, 4, 5}, lean.col(2)) < 1e-3 * 20);
}

TEST_CASE("a cup is held by its outer wall around its axis") {
  const solids::FrustumShell options;
  const GeneralizedCylinder cylinder = cylinder_of(fit_primitive(solids::frustum_shell(options)));
  CHECK(farthest_from_line(cylinder.centres, {0, 0, 0}, {0, 0, 1}) < 1e-9);
  for (Eigen::Index i = 0; i < cylinder.radii.size(); ++i)
    CHECK(cylinder.radii(i) == Approx(3 + cylinder.centres(i, 2) / 8).epsilon(1e-8));
  CHECK(length_of(cylinder) == Approx(8));
}

TEST_CASE("a torus is a closed cylinder through the middle of its tube") {
  const FittedPrimitive fitted = fit_primitive(solids::torus({}));
  const GeneralizedCylinder& cylinder = cylinder_of(fitted);
  CHECK(cylinder.closed);
  for (const auto& centre : cylinder.centres.rowwise()) {
    CHECK(centre.head<2>().norm() == Approx(3));
    CHECK(centre.z() == Approx(0).margin(1e-9));
  }
  // Between the inscribed and the circumscribed circle of the 16-gon.
  CHECK(cylinder.radii.minCoeff() > std::cos(pi / 16) - 0.01);
  CHECK(cylinder.radii.maxCoeff() < 1);
  CHECK(*fitted.fit.cylinder_error < 0.01);
}

TEST_CASE("a bent tube is followed from end to end") {
  const double angle = 1.25 * pi;
  const FittedPrimitive fitted = fit_primitive(arc_tube(3, 0.4, angle));
  const GeneralizedCylinder& cylinder = cylinder_of(fitted);
  CHECK_FALSE(cylinder.closed);
  CHECK(fitted.fit.note == "along its curve skeleton");
  CHECK(length_of(cylinder) == Approx(3 * angle).epsilon(0.01));
  for (Eigen::Index i = 0; i < cylinder.radii.size(); ++i) {
    CHECK(cylinder.radii(i) == Approx(0.4).epsilon(0.03));
    CHECK(cylinder.centres.row(i).norm() == Approx(3).epsilon(0.01));
    CHECK(cylinder.centres(i, 1) == Approx(0).margin(0.02));
  }
  CHECK(*fitted.fit.cylinder_error < 0.005);
  CHECK(fitted.fit.cuboid_error > 0.05);
}

TEST_CASE("open and torn tubes are wrapped and say so") {
  const Shape tube = arc_tube(3, 0.4, 1.25 * pi);
  const auto holds = [&](const Shape& shape) {
    const FittedPrimitive fitted = fit_primitive(shape);
    const GeneralizedCylinder& cylinder = cylinder_of(fitted);
    CHECK(fitted.fit.note.find("wrapped") != std::string::npos);
    CHECK_FALSE(cylinder.closed);
    CHECK(length_of(cylinder) == Approx(3 * 1.25 * pi).epsilon(0.03));
    CHECK(cylinder.radii.mean() == Approx(0.4).epsilon(0.05));
  };
  holds(part_where(tube, [](Eigen::Index t) { return t % 130 < 128; }));  // without its end caps
  holds(part_where(tube, [](Eigen::Index t) { return t % 7 != 0; }));
  Shape soup = part_where(tube, [](Eigen::Index t) { return t % 7 != 0; });
  for (Eigen::Index t = 0; t < soup.triangle_count(); t += 3)
    std::swap(soup.triangles(t, 0), soup.triangles(t, 1));
  holds(soup);
}

TEST_CASE("which way triangles are turned, and their order, does not matter") {
  const Shape cup = solids::frustum_shell({});
  const FittedPrimitive fitted = fit_primitive(cup);
  for (const Shape& other : {solids::flipped(cup), solids::permuted(cup, 5), solids::subdivided(cup)}) {
    const FittedPrimitive again = fit_primitive(other);
    const GeneralizedCylinder &a = cylinder_of(fitted), &b = cylinder_of(again);
    CHECK((a.centres - b.centres).norm() == Approx(0).margin(1e-8));
    CHECK((a.radii - b.radii).norm() == Approx(0).margin(1e-6));
    CHECK(again.fit.cuboid_error == Approx(fitted.fit.cuboid_error).epsilon(0.02));
  }
  const Shape tube = arc_tube(3, 0.4, 1.25 * pi);
  const FittedPrimitive bent = fit_primitive(solids::flipped(tube));
  CHECK(bent.fit.note == "along its curve skeleton");
  CHECK(length_of(cylinder_of(bent)) == Approx(3 * 1.25 * pi).epsilon(0.01));
}

TEST_CASE("fits move and grow with the part") {
  const Shape cup = solids::frustum_shell({});
  const GeneralizedCylinder rest = cylinder_of(fit_primitive(cup));
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const double scale = std::pow(10.0, static_cast<double>(seed) * 3 - 6);
    const FittedPrimitive fitted = fit_primitive(posed(cup, seed, scale));
    const GeneralizedCylinder& cylinder = cylinder_of(fitted);
    const Eigen::Vector3d axis = solids::random_rotation(seed).col(2);
    CHECK(farthest_from_line(cylinder.centres, {3, -7, 11}, axis) < 1e-7 * std::max(1.0, scale));
    const bool same_way = axis.z() > 0;  // cylinders run upward
    for (int i = 0; i < 24; ++i)
      CHECK(cylinder.radii(same_way ? i : 23 - i) == Approx(scale * rest.radii(i)).epsilon(1e-6));
  }
  const FittedPrimitive bent = fit_primitive(arc_tube(3, 0.4, 1.25 * pi));
  const FittedPrimitive elsewhere = fit_primitive(posed(arc_tube(3, 0.4, 1.25 * pi), 7, 50));
  CHECK(length_of(cylinder_of(elsewhere)) == Approx(50 * length_of(cylinder_of(bent))).epsilon(0.005));
  CHECK(cylinder_of(elsewhere).radii.mean() == Approx(50 * cylinder_of(bent).radii.mean()).epsilon(0.02));
}

TEST_CASE("the kind that holds a part better is chosen, unless the user says otherwise") {
  const Shape leg = solids::box({1, 1, 12}), rod = solids::cylinder(0.5, 12, 16);
  CHECK(std::holds_alternative<Cuboid>(fit_primitive(leg).primitive));
  CHECK(std::holds_alternative<GeneralizedCylinder>(fit_primitive(rod).primitive));
  cuboid_in(fit_primitive(rod, {.kind = PrimitiveKind::cuboid}));
  const GeneralizedCylinder forced = cylinder_of(fit_primitive(leg, {.kind = PrimitiveKind::cylinder}));
  CHECK(farthest_from_line(forced.centres, {0.5, 0.5, 0}, {0, 0, 1}) < 1e-9);
  CHECK(length_of(forced) == Approx(12));
  CHECK(forced.radii.minCoeff() > 0.5);
  CHECK(forced.radii.maxCoeff() < std::sqrt(0.5));
  // Around the hole of a frame most of a box is empty.
  const Shape frame = solids::u_shape(10, 1);
  CHECK(std::holds_alternative<GeneralizedCylinder>(fit_primitive(frame).primitive));
}

TEST_CASE("a part of several shells is one part") {
  const Shape dumbbell = concatenate(concatenate(solids::cylinder(1, 2, 24), solids::cylinder(0.25, 8, 24)),
                                     solids::moved(solids::cylinder(1, 2, 24), {0, 0, 6}));
  const GeneralizedCylinder cylinder = cylinder_of(fit_primitive(dumbbell));
  for (Eigen::Index i = 0; i < cylinder.radii.size(); ++i) {
    const double height = cylinder.centres(i, 2);
    CHECK(cylinder.radii(i) == Approx(height < 2 || height > 6 ? 1 : 0.25).epsilon(1e-6));
  }
}

TEST_CASE("a sheet is a thickened cuboid, and never a cylinder") {
  Points points(4, 3);
  points << 0, 0, 1, 4, 0, 1, 4, 3, 1, 0, 3, 1;
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 0, 2, 3;
  const Shape sheet = make_shape(points, triangles);
  const FittedPrimitive fitted = fit_primitive(sheet);
  const Cuboid& cuboid = cuboid_in(fitted);
  CHECK(cuboid.corners(4, 2) - cuboid.corners(0, 2) == Approx(5 * tolerance::min_thickness));
  CHECK(volume(fitted.primitive) == Approx(12 * 5 * tolerance::min_thickness));
  CHECK_FALSE(fitted.fit.cylinder_error);
  CHECK(fitted.fit.note == "thickened to a thousandth of its diagonal");
  CHECK_THROWS_AS(fit_primitive(sheet, {.kind = PrimitiveKind::cylinder}), UsageError);
}

TEST_CASE("a part without area, and a cylinder of too few sections, are refused") {
  Points line(3, 3);
  line << 0, 0, 0, 1, 0, 0, 2, 0, 0;
  Triangles triangles(1, 3);
  triangles << 0, 1, 2;
  CHECK_THROWS_AS(fit_primitive(make_shape(line, triangles)), InputError);
  CHECK_THROWS_AS(fit_primitive(solids::box({1, 1, 1}), {.kind = {}, .sections = 3}), UsageError);
}

TEST_CASE("the same part gives the same bits, in any thread") {
  const Shape tube = arc_tube(3, 0.4, 1.25 * pi);
  const Shape torn = part_where(tube, [](Eigen::Index t) { return t % 7 != 0; });
  for (const Shape& shape : {tube, torn}) {
    const FittedPrimitive first = fit_primitive(shape);
    const FittedPrimitive second = std::async(std::launch::async, [&] { return fit_primitive(shape); }).get();
    CHECK(cylinder_of(first).centres == cylinder_of(second).centres);
    CHECK(cylinder_of(first).radii == cylinder_of(second).radii);
    CHECK(first.fit.cylinder_error == second.fit.cylinder_error);
  }
}
