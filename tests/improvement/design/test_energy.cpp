#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "stackabilization/core/errors.h"
#include "stackabilization/improvement/energy.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/structures.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

Design design_of(const StructuredShape& structured) {
  Design design;
  design.shape = structured.shape;
  for (const Part& part : structured.structure.parts) design.primitives.push_back(part.primitive);
  return design;
}

Primitive mapped(Primitive primitive, const Eigen::Affine3d& map, double factor) {
  const auto apply = [&](auto& points) {
    for (Eigen::Index i = 0; i < points.rows(); ++i)
      points.row(i) = (map * Eigen::Vector3d(points.row(i).transpose())).transpose();
  };
  if (auto* cuboid = std::get_if<Cuboid>(&primitive)) {
    apply(cuboid->corners);
  } else {
    auto& cylinder = std::get<GeneralizedCylinder>(primitive);
    apply(cylinder.centres);
    cylinder.radii *= factor;
  }
  return primitive;
}

/// The vertices and the primitive of one part moved; parts share no vertices here.
Design with_part(Design design, int part, const Eigen::Affine3d& map) {
  std::vector<char> moved(static_cast<std::size_t>(design.shape.vertex_count()), 0);
  for (Eigen::Index t = 0; t < design.shape.triangle_count(); ++t)
    if (design.shape.triangle_part[static_cast<std::size_t>(t)] == part)
      for (int k = 0; k < 3; ++k) moved[static_cast<std::size_t>(design.shape.triangles(t, k))] = 1;
  for (std::size_t v = 0; v < moved.size(); ++v) {
    const auto row = static_cast<Eigen::Index>(v);
    if (moved[v] != 0)
      design.shape.vertices.row(row) =
          (map * Eigen::Vector3d(design.shape.vertices.row(row).transpose())).transpose();
  }
  auto& primitive = design.primitives[static_cast<std::size_t>(part)];
  primitive = mapped(primitive, map, 1);
  return design;
}

StructuredShape mapped(StructuredShape structured, const Eigen::Affine3d& map, double factor) {
  structured.shape = transformed(structured.shape, map.linear(), map.translation());
  for (Part& part : structured.structure.parts) part.primitive = mapped(part.primitive, map, factor);
  for (Relation& relation : structured.structure.relations) {
    relation.symmetry.point = map * relation.symmetry.point;
    relation.symmetry.axis = (map.linear() * relation.symmetry.axis).normalized();
    for (Eigen::Index i = 0; i < relation.points.rows(); ++i)
      relation.points.row(i) = (map * Eigen::Vector3d(relation.points.row(i).transpose())).transpose();
  }
  structured.structure.diagonal *= factor;
  return structured;
}

Eigen::Affine3d translation(const Eigen::Vector3d& by) {
  return Eigen::Affine3d(Eigen::Translation3d(by));
}

/// Two posts 1 x 1 x 4 whose axes are 3 apart, mirror images in x = 0. Box 4 x 1 x 4.
StructuredShape two_posts() {
  StructuredShape posts;
  for (const double x : {-1.5, 1.5}) {
    Shape post = solids::box({x - 0.5, -0.5, 0}, {x + 0.5, 0.5, 4});
    post.part_names = {x < 0 ? "left" : "right"};
    posts.shape = x < 0 ? post : concatenate(posts.shape, post);
    posts.structure.parts.push_back(
        {post.part_names[0], cuboid_of({{x, 0, 2}, Eigen::Matrix3d::Identity(), {0.5, 0.5, 2}}), {}});
  }
  Relation mirror;
  mirror.parts = {0, 1};
  mirror.symmetry.axis = Eigen::Vector3d::UnitX();
  posts.structure.relations = {mirror};
  posts.structure.diagonal = std::sqrt(33.0);
  return posts;
}

/// A primitive whose axis is the segment from a to b.
Primitive rod(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return structures::straight_cylinder(a, b, 0.1, 2);
}

}  // namespace

TEST_CASE("Moving a part apart changes distances, box and symmetry by hand-computed amounts", "[energy]") {
  const StructuredShape rest = two_posts();
  const Design apart = with_part(design_of(rest), 1, translation({1, 0, 0}));
  for (const BoxModel boxes : {BoxModel::frame, BoxModel::oriented}) {
    const Distortion d = EnergyMeter(rest, boxes).distortion(apart);
    CHECK(d.volume == Approx(0).margin(1e-14));
    CHECK(d.proximity == Approx(1.0 / 3));
    CHECK(d.box == Approx(1.0 / 9));
    // Eight corners miss their images by 1 each.
    CHECK(d.symmetry == Approx(8 / std::sqrt(33.0)));
    CHECK(d.total() == Approx((1.0 / 3 + 1.0 / 9 + 8 / std::sqrt(33.0)) / 4));
  }
  // A move along the axes leaves their distance.
  const Distortion along =
      EnergyMeter(rest, BoxModel::frame).distortion(with_part(design_of(rest), 1, translation({0, 0, 1})));
  CHECK(along.proximity == Approx(0).margin(1e-14));
  CHECK(along.box == Approx(1.0 / 9));
}

TEST_CASE("Volumes change by what their primitives gain and lose", "[energy]") {
  const StructuredShape rest = two_posts();
  const EnergyMeter meter(rest, BoxModel::frame);
  Eigen::Affine3d wider(Eigen::Scaling(1.0, 2.0, 1.0)), thinner(Eigen::Scaling(1.0, 0.5, 1.0));
  // 4 gained and 2 lost, of 8: absolute values are summed.
  const Distortion d = meter.distortion(with_part(with_part(design_of(rest), 0, wider), 1, thinner));
  CHECK(d.volume == Approx(6.0 / 8));
  CHECK(d.proximity == Approx(0).margin(1e-14));
  CHECK(d.box == Approx(1.0 / 9));

  const StructuredShape tube =
      structures::tube_alone(structures::straight_cylinder({0, 0, 0}, {0, 0, 5}, 1, 6), 12);
  Design inflated = design_of(tube);
  std::get<GeneralizedCylinder>(inflated.primitives[0]).radii *= 2;
  CHECK(EnergyMeter(tube, BoxModel::frame).distortion(inflated).volume == Approx(3));
}

TEST_CASE("Doubling everything about the mirror plane", "[energy]") {
  const StructuredShape rest = two_posts();
  const Design twice = design_of(mapped(rest, Eigen::Affine3d(Eigen::Scaling(2.0)), 2));
  const Distortion d = EnergyMeter(rest, BoxModel::oriented).distortion(twice);
  CHECK(d.volume == Approx(7));
  CHECK(d.proximity == Approx(1));
  CHECK(d.box == Approx(1));
  CHECK(d.symmetry == Approx(0).margin(1e-13));
}

TEST_CASE("Nothing is distorted at rest, to the bit", "[energy]") {
  const Eigen::Affine3d tilt(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  for (const StructuredShape& made : {two_posts(), structures::table(1), structures::mug(),
                                      structures::post_with_ring(), structures::table_with_line_joints()})
    for (const StructuredShape& rest : {made, mapped(made, tilt, 1)})
      for (const BoxModel boxes : {BoxModel::frame, BoxModel::oriented}) {
        const Energy e = EnergyMeter(rest, boxes).energy(design_of(rest), 0);
        CHECK(e.distortion.volume == 0);
        CHECK(e.distortion.proximity == 0);
        CHECK(e.distortion.box == 0);
        CHECK(e.distortion.symmetry == 0);
        CHECK(e.value == 0);
      }
}

TEST_CASE("A symmetry that is missed at rest counts only beyond that", "[energy]") {
  StructuredShape rest = two_posts();
  rest.structure.relations[0].symmetry.point = {0.05, 0, 0};
  const EnergyMeter meter(rest, BoxModel::frame);
  CHECK(meter.distortion(design_of(rest)).symmetry == 0);
  const Design worse = with_part(design_of(rest), 1, translation({-1, 0, 0}));
  CHECK(meter.distortion(worse).symmetry == Approx(8 * 1.0 / std::sqrt(33.0)));
}

TEST_CASE("Distortion has no unit", "[energy]") {
  const StructuredShape rest = structures::table();
  const Design bent = with_part(with_part(design_of(rest), 1, translation({0.3, -0.2, 0})), 0,
                                Eigen::Affine3d(Eigen::Scaling(1.1, 0.9, 1.0)));
  const Distortion small = EnergyMeter(rest, BoxModel::oriented).distortion(bent);
  CHECK(small.symmetry > 0);
  for (const double factor : {1e-3, 1000.0}) {
    const Eigen::Affine3d scale(Eigen::Scaling(factor));
    Design scaled = bent;
    scaled.shape = transformed(bent.shape, scale.linear(), scale.translation());
    for (Primitive& primitive : scaled.primitives) primitive = mapped(primitive, scale, factor);
    const Distortion d = EnergyMeter(mapped(rest, scale, factor), BoxModel::oriented).distortion(scaled);
    CHECK(d.volume == Approx(small.volume).epsilon(1e-9));
    CHECK(d.proximity == Approx(small.proximity).epsilon(1e-9));
    CHECK(d.box == Approx(small.box).epsilon(1e-9));
    CHECK(d.symmetry == Approx(small.symmetry).epsilon(1e-9));
  }
}

TEST_CASE("The main axes are the file's or those of the minimal box", "[energy]") {
  const Eigen::Affine3d tilt(Eigen::AngleAxisd(std::numbers::pi / 6, Eigen::Vector3d::UnitZ()));
  const StructuredShape rest = mapped(structures::box_alone({4, 2, 1}), tilt, 1);
  // Half as long again along its own first axis.
  const Eigen::Affine3d stretch = tilt * Eigen::Scaling(1.5, 1.0, 1.0) * tilt.inverse();
  const Design longer = with_part(design_of(rest), 0, stretch);
  CHECK(EnergyMeter(rest, BoxModel::oriented).distortion(longer).box == Approx(2.0 / 7));
  // Along the file's axes a rectangle of a x b, turned by 30 degrees, measures a c + b s by a s + b c.
  const double c = std::sqrt(3.0) / 2, s = 0.5;
  CHECK(EnergyMeter(rest, BoxModel::frame).distortion(longer).box == Approx(2 * (c + s) / (6 * (c + s) + 1)));
}

TEST_CASE("Alpha weighs distortion against gain", "[energy]") {
  const StructuredShape rest = two_posts();
  const Design apart = with_part(design_of(rest), 1, translation({1, 0, 0}));
  const double d = EnergyMeter(rest, BoxModel::frame).distortion(apart).total();
  CHECK(EnergyMeter(rest, BoxModel::frame, 1).energy(apart, 0.3).value == d);
  CHECK(EnergyMeter(rest, BoxModel::frame, 0).energy(apart, 0.3).value == -0.3);
  CHECK(EnergyMeter(rest, BoxModel::frame).energy(apart, 0.3).value == Approx(0.2 * d - 0.8 * 0.3));
  CHECK_THROWS_AS(EnergyMeter(rest, BoxModel::frame, -0.1), UsageError);
  CHECK_THROWS_AS(EnergyMeter(rest, BoxModel::frame, 1.1), UsageError);
  CHECK_THROWS_AS(EnergyMeter(rest, BoxModel::frame, std::nan("")), UsageError);
}

TEST_CASE("Designs of something else are refused", "[energy]") {
  const StructuredShape rest = two_posts();
  const EnergyMeter meter(rest, BoxModel::frame);
  Design fewer = design_of(rest);
  fewer.primitives.pop_back();
  CHECK_THROWS_AS(meter.distortion(fewer), UsageError);
  Design other = design_of(rest);
  other.primitives[0] = rod({0, 0, 0}, {0, 0, 1});
  CHECK_THROWS_AS(meter.distortion(other), UsageError);
  CHECK_THROWS_AS(meter.distortion(design_of(structures::table())), UsageError);
}

TEST_CASE("Axes that all cross at rest are compared over the diagonal", "[energy]") {
  StructuredShape cross = two_posts();
  cross.structure.relations.clear();
  cross.structure.parts[0].primitive = rod({-2, 0, 0}, {2, 0, 0});
  cross.structure.parts[1].primitive = rod({0, -2, 0}, {0, 2, 0});
  Design lifted = design_of(cross);
  lifted.primitives[1] = rod({0, -2, 0.5}, {0, 2, 0.5});
  const EnergyMeter meter(cross, BoxModel::frame);
  CHECK(meter.distortion(design_of(cross)).proximity == 0);
  CHECK(meter.distortion(lifted).proximity == Approx(0.5 / std::sqrt(33.0)));
}

TEST_CASE("Distances of axes in closed form", "[energy]") {
  const Primitive x = rod({-1, 0, 0}, {1, 0, 0});
  CHECK(axis_distance(x, rod({0, -1, 0}, {0, 1, 0})) == 0);          // crossing
  CHECK(axis_distance(x, rod({0, -1, 2}, {0, 1, 2})) == Approx(2));  // skew, above each other
  CHECK(axis_distance(x, rod({-5, 3, 0}, {5, 3, 0})) == Approx(3));  // parallel, overlapping
  CHECK(axis_distance(x, rod({4, 4, 0}, {9, 4, 0})) == Approx(5));   // parallel, past the end
  CHECK(axis_distance(x, rod({3, 0, 0}, {4, 0, 0})) == Approx(2));   // on one line
  CHECK(axis_distance(x, rod({0, 1, 0}, {0, 4, 0})) == Approx(1));   // end over the middle
  CHECK(axis_distance(x, x) == 0);

  // The axis of a box is its longest one, of a cube the first.
  const Primitive tall = cuboid_of({{0, 0, 0}, Eigen::Matrix3d::Identity(), {1, 1, 3}});
  const Primitive cube = cuboid_of({{0, 5, 0}, Eigen::Matrix3d::Identity(), {1, 1, 1}});
  CHECK(axis_distance(tall, cube) == Approx(5));
  CHECK(axis_distance(rod({9, 5, 0}, {9, 5, 1}), cube) == Approx(8));
  // A ring is as far from its centre as its circle's polygon.
  const GeneralizedCylinder ring = structures::ring_cylinder(2, 0.1, 8);
  CHECK(axis_distance(ring, rod({0, 0, -1}, {0, 0, 1})) == Approx(2 * std::cos(std::numbers::pi / 8)));
  // The piece that closes it counts.
  GeneralizedCylinder open = ring;
  open.closed = false;
  const Eigen::Vector3d gap = (ring.centres.row(0) + ring.centres.row(7)).transpose() / 2;
  const Primitive through_gap = rod(gap - Eigen::Vector3d::UnitZ(), gap + Eigen::Vector3d::UnitZ());
  CHECK(axis_distance(ring, through_gap) == Approx(0).margin(1e-15));
  CHECK(axis_distance(open, through_gap) > 0.5);
}

TEST_CASE("Distances of axes agree with dense sampling, also for nearly parallel ones", "[energy]") {
  solids::Random random(7);
  for (int trial = 0; trial < 60; ++trial) {
    const Eigen::Vector3d a = random.in_cube(), b = random.in_cube(), c = random.in_cube();
    const double slant = trial % 3 == 0 ? 0 : trial % 3 == 1 ? 1e-9 : 1;
    const Eigen::Vector3d d = c + random.uniform(-1, 1) * (b - a) + slant * random.in_cube();
    const double found = axis_distance(rod(a, b), rod(c, d));
    double sampled = 10;
    constexpr int steps = 200;
    for (int i = 0; i <= steps; ++i) {
      const Eigen::Vector3d p = a + (b - a) * i / steps;
      const double t = std::clamp((p - c).dot(d - c) / (d - c).squaredNorm(), 0.0, 1.0);
      sampled = std::min(sampled, (p - c - t * (d - c)).norm());
    }
    CHECK(found <= sampled + 1e-12);
    CHECK(found >= sampled - (b - a).norm() / steps / 2);
    CHECK(axis_distance(rod(c, d), rod(a, b)) == Approx(found).margin(1e-12));
  }
}

TEST_CASE("The distance of two curves is the least one of their pieces", "[energy]") {
  solids::Random random(11);
  for (int trial = 0; trial < 40; ++trial) {
    GeneralizedCylinder a = structures::straight_cylinder({0, 0, 0}, {1, 0, 0}, 0.1, 6), b = a;
    for (Eigen::Index i = 0; i < 6; ++i) {
      a.centres.row(i) = random.in_cube().transpose();
      b.centres.row(i) = random.in_cube().transpose() + Eigen::RowVector3d(2, 0, 0);
    }
    double least = 10;
    for (Eigen::Index i = 0; i < 5; ++i)
      for (Eigen::Index j = 0; j < 5; ++j)
        least = std::min(least,
                         axis_distance(rod(a.centres.row(i).transpose(), a.centres.row(i + 1).transpose()),
                                       rod(b.centres.row(j).transpose(), b.centres.row(j + 1).transpose())));
    CHECK(axis_distance(a, b) == Approx(least).epsilon(1e-12));
  }
}
