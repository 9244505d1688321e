#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "deformation/carried/carried_primitives.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/controller_model.h"
#include "stackabilization/deformation/factory.h"
#include "stackabilization/deformation/surface_model.h"
#include "stackabilization/mesh/boxes.h"
#include "support/catch.h"
#include "support/handles.h"
#include "support/structures.h"

using namespace stackabilization;

namespace {

const std::vector<DeformationKind>& kinds = deformation_kinds();
const Eigen::Vector3d z_axis = Eigen::Vector3d::UnitZ();

bool same_primitive(const Primitive& a, const Primitive& b) {
  if (const auto* cuboid = std::get_if<Cuboid>(&a)) return cuboid->corners == std::get<Cuboid>(b).corners;
  const auto &p = std::get<GeneralizedCylinder>(a), &q = std::get<GeneralizedCylinder>(b);
  return p.centres == q.centres && p.radii == q.radii && p.rotation.coeffs() == q.rotation.coeffs();
}

bool same_design(const Design& a, const Design& b) {
  bool equal = a.edits.size() == b.edits.size() && a.primitives.size() == b.primitives.size() &&
               a.shape.vertices == b.shape.vertices && a.shape.triangles == b.shape.triangles;
  for (std::size_t k = 0; equal && k < a.primitives.size(); ++k)
    equal = same_primitive(a.primitives[k], b.primitives[k]);
  for (std::size_t k = 0; equal && k < a.edits.size(); ++k)
    equal = a.edits[k].handle == b.edits[k].handle && a.edits[k].falloff == b.edits[k].falloff &&
            describe(a.edits[k], a.shape.part_names) == describe(b.edits[k], b.shape.part_names);
  return equal;
}

std::unique_ptr<DeformationModel> table_designs(DeformationKind kind) {
  return deformation_model(structures::table(1), {kind, Direction(0, 0, 1)});
}

/// Three edits that the model takes.
std::vector<Edit> edits_for(DeformationKind kind, const DeformationModel& space) {
  if (kind == DeformationKind::gap_scaling)
    return {{whole_shape, Scale{0.9, z_axis}},
            {whole_shape, Scale{0.8, z_axis}},
            {whole_shape, Scale{1.1, z_axis}}};
  std::vector<Edit> edits = {{whole_shape, Scale{1.1, {}}}};
  if (kind == DeformationKind::controllers) {
    edits.push_back({{HandleKind::face, 0, 5}, Move{{0, 0, 0.3}}});
    edits.push_back({{HandleKind::part, 1, 0}, Move{{0.2, 0.1, 0}}});
  } else if (kind == DeformationKind::surface) {
    edits.push_back({{HandleKind::part, 0, 0}, Move{{0, 0, 0.3}}});
    edits.push_back({{HandleKind::part, 0, 0}, Scale{1.05, {}}});
  } else {
    edits.push_back({space.handles().back(), Move{{0, 0, 0.1}}});
    edits.push_back({space.handles()[1], Scale{1.05, {}}});
  }
  return edits;
}

double extent(const Shape& shape, const Eigen::Vector3d& direction) {
  return range_along(shape, direction).length();
}

/// The mug, and a flat square beside it.
StructuredShape mug_and_plate() {
  StructuredShape all = structures::mug();
  Points corners(4, 3);
  corners << 5, 0, 1, 6, 0, 1, 6, 1, 1, 5, 1, 1;
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 0, 2, 3;
  Shape plate = make_shape(corners, triangles);
  plate.part_names = {"plate"};
  all.shape = concatenate(all.shape, plate);
  const Primitive box = cuboid_of({{5.5, 0.5, 1}, Eigen::Matrix3d::Identity(), {0.5, 0.5, 0.01}});
  all.structure.parts.push_back({"plate", box, {}});
  return all;
}

}  // namespace

TEST_CASE("every kind of deformation has a name of its own") {
  CHECK(name_of(DeformationKind::controllers) == "controllers");
  CHECK(name_of(DeformationKind::surface) == "surface");
  CHECK(name_of(DeformationKind::iwires) == "iwires");
  CHECK(name_of(DeformationKind::gap_scaling) == "gap-scaling");
}

TEST_CASE("without edits a design is the shape at rest, to the bit") {
  for (const DeformationKind kind : kinds) {
    INFO(name_of(kind));
    const auto space = table_designs(kind);
    CHECK(space->kind() == kind);
    const StructuredShape& rest = space->rest();
    for (const Design& design : {space->at_rest(), space->deformed({}, {}).design}) {
      CHECK(design.edits.empty());
      CHECK(design.shape.vertices == rest.shape.vertices);
      REQUIRE(design.primitives.size() == rest.structure.parts.size());
      for (std::size_t k = 0; k < design.primitives.size(); ++k)
        CHECK(same_primitive(design.primitives[k], rest.structure.parts[k].primitive));
    }
  }
}

TEST_CASE("edits made again from rest give the same bits as one after the other") {
  for (const DeformationKind kind : kinds) {
    INFO(name_of(kind));
    const auto space = table_designs(kind);
    const std::vector<Edit> edits = edits_for(kind, *space);
    Design now = space->at_rest();
    for (std::size_t k = 0; k < edits.size(); ++k) {
      const DeformationResult outcome = space->edited(now, edits[k], {});
      if (outcome.refusal) FAIL(describe(*outcome.refusal, space->rest().structure));
      CHECK_FALSE(outcome.design.shape.vertices == now.shape.vertices);
      now = outcome.design;
      const DeformationResult again = space->deformed({edits.begin(), edits.begin() + k + 1}, {});
      CHECK_FALSE(again.refusal);
      CHECK(same_design(again.design, now));
    }
    CHECK(now.edits.size() == edits.size());
  }
}

TEST_CASE("designs are what the models make") {
  const StructuredShape rest = structures::table(1);
  const auto controllers = table_designs(DeformationKind::controllers);
  const std::vector<Edit> edits = edits_for(DeformationKind::controllers, *controllers);
  const DeformationResult result = ControllerModel(rest).deformed(edits);
  const Design design = controllers->deformed(edits, {}).design;
  CHECK(design.shape.vertices == result.design.shape.vertices);
  for (std::size_t k = 0; k < design.primitives.size(); ++k)
    CHECK(same_primitive(design.primitives[k], result.design.primitives[k]));
  SurfaceModelOptions upright;
  upright.axis = z_axis;
  const auto surface = table_designs(DeformationKind::surface);
  const std::vector<Edit> pulls = edits_for(DeformationKind::surface, *surface);
  CHECK(surface->deformed(pulls, {}).design.shape.vertices ==
        surface_model(rest, upright)->deformed(pulls).design.shape.vertices);
}

TEST_CASE("the direction is that of the gap and the axis of slices") {
  const auto sideways =
      deformation_model(structures::table(), {DeformationKind::gap_scaling, Direction(1, 0, 0)});
  CHECK_FALSE(
      sideways->edited(sideways->at_rest(), {whole_shape, Scale{0.9, Eigen::Vector3d(1, 0, 0)}}, {}).refusal);
  CHECK_THROWS_AS(sideways->edited(sideways->at_rest(), {whole_shape, Scale{0.9, z_axis}}, {}), UsageError);
  const auto surface = deformation_model(structures::mug(), {DeformationKind::surface, Direction(0, 0, 1)});
  const Edit wider{{HandleKind::section, 0, 23}, Scale{1.2, {}}};
  const Shape after = surface->edited(surface->at_rest(), wider, {}).design.shape;
  const Points moved = after.vertices - surface->rest().shape.vertices;
  CHECK(moved.leftCols<2>().cwiseAbs().maxCoeff() > 0.01);
  Eigen::Index widest = 0;
  moved.rowwise().norm().maxCoeff(&widest);
  const Range height = range_along(surface->rest().shape, z_axis);
  CHECK(surface->rest().shape.vertices(widest, 2) > height.low + 0.5 * height.length());
}

TEST_CASE("constraints hold in every design, or it stays what it was") {
  DeformationConstraints constraints;
  constraints.keep_extent = Direction(0, 0, 1);
  for (const DeformationKind kind : kinds) {
    INFO(name_of(kind));
    const auto space = table_designs(kind);
    const double height = extent(space->rest().shape, z_axis);
    Design now = space->at_rest();
    for (const Edit& edit : edits_for(kind, *space)) {
      const DeformationResult outcome = space->edited(now, edit, constraints);
      if (outcome.refusal)
        CHECK(same_design(outcome.design, now));
      else
        CHECK(extent(outcome.design.shape, z_axis) == Approx(height).epsilon(1e-9));
      now = outcome.design;
    }
  }
}

TEST_CASE("a refused edit ends a replay with what the edits before it made") {
  const auto space = table_designs(DeformationKind::controllers);
  DeformationConstraints constraints;
  constraints.fixed_parts = {1};
  const Edit allowed{{HandleKind::face, 0, 5}, Move{{0, 0, 0.3}}};
  const Edit forbidden{{HandleKind::part, 1, 0}, Move{{0.2, 0.1, 0}}};
  const DeformationResult first = space->deformed({allowed}, constraints);
  CHECK_FALSE(first.refusal);
  const DeformationResult stopped = space->deformed({allowed, forbidden, allowed}, constraints);
  REQUIRE(stopped.refusal);
  CHECK(same_design(stopped.design, first.design));
  CHECK(same_primitive(stopped.design.primitives[1], space->at_rest().primitives[1]));
}

TEST_CASE("handles that a model lacks are refused as usage") {
  const Edit face{{HandleKind::face, 0, 5}, Move{{0, 0, 0.3}}};
  for (const DeformationKind kind :
       {DeformationKind::surface, DeformationKind::iwires, DeformationKind::gap_scaling}) {
    const auto space = table_designs(kind);
    CHECK_THROWS_AS(space->edited(space->at_rest(), face, {}), UsageError);
  }
  StructuredShape broken = structures::table();
  broken.structure.parts.pop_back();
  for (const DeformationKind kind : kinds)
    CHECK_THROWS_AS(deformation_model(broken, {kind, Direction(0, 0, 1)}), InputError);
}

TEST_CASE("carried primitives follow an affine map exactly") {
  const StructuredShape rest = mug_and_plate();
  const detail::CarriedPrimitives carried(rest);
  Eigen::Matrix3d linear;
  linear << 1.1, 0.2, -0.1, -0.3, 0.8, 0.1, 0.05, 0.15, 1.3;
  const Eigen::RowVector3d shift(3, -2, 1);
  const Points moved = (rest.shape.vertices * linear.transpose()).rowwise() + shift;
  const std::vector<Primitive> now = carried.at(moved);
  for (std::size_t part = 0; part < 2; ++part) {
    const auto& before = std::get<GeneralizedCylinder>(rest.structure.parts[part].primitive);
    const auto& after = std::get<GeneralizedCylinder>(now[part]);
    const Points centres = (before.centres * linear.transpose()).rowwise() + shift;
    CHECK((after.centres - centres).cwiseAbs().maxCoeff() < 1e-12);
    const Points tangents = section_tangents(before);
    for (Eigen::Index i = 0; i < centres.rows(); ++i) {
      // Nanson: an area with normal t becomes det(A) |A^-T t| times as large.
      const double area =
          linear.determinant() * (linear.inverse().transpose() * tangents.row(i).transpose()).norm();
      CHECK(after.radii(i) == Approx(before.radii(i) * std::sqrt(area)).epsilon(1e-12));
    }
    // Polar decomposition: what the rotation leaves is symmetric.
    const Eigen::Matrix3d stretch = after.rotation.toRotationMatrix().transpose() * linear;
    CHECK((stretch - stretch.transpose()).norm() < 1e-12);
  }
}

TEST_CASE("a flat part carries its primitive by a translation") {
  const StructuredShape rest = mug_and_plate();
  const detail::CarriedPrimitives carried(rest);
  const Eigen::Vector3d shift(1, 2, 3);
  const auto& before = std::get<Cuboid>(rest.structure.parts[2].primitive).corners;
  const Points moved = rest.shape.vertices.rowwise() + shift.transpose();
  CHECK((std::get<Cuboid>(carried.at(moved)[2]).corners - (before.rowwise() + shift.transpose())).norm() <
        1e-14);
  Points wider = rest.shape.vertices;
  wider.col(0) *= 2;
  const auto after = std::get<Cuboid>(carried.at(wider)[2]).corners;
  CHECK((after - (before.rowwise() + Eigen::RowVector3d(5.5, 0, 0))).norm() < 1e-13);
}

TEST_CASE("carried primitives fit in the least-squares sense, and stay where nothing moves") {
  const StructuredShape rest = structures::box_alone({2, 2, 2});
  const detail::CarriedPrimitives carried(rest);
  // Normal equations: moving vertex v by d moves p by (1 / n + p . M^-1 v) d, M the moments of the n
  // vertices.
  Points moved = rest.shape.vertices;
  const Eigen::RowVector3d centre = moved.colwise().mean(), d(0.1, 0.2, 0.3);
  const Points offsets = moved.rowwise() - centre;
  const Eigen::Matrix3d moments = offsets.transpose() * offsets;
  const Eigen::Vector3d reduced_costs = moments.inverse() * offsets.row(3).transpose();
  moved.row(3) += d;
  const auto& before = std::get<Cuboid>(rest.structure.parts[0].primitive).corners;
  const auto after = std::get<Cuboid>(carried.at(moved)[0]).corners;
  for (int k = 0; k < 8; ++k) {
    const double share = 1 / static_cast<double>(moved.rows()) + (before.row(k) - centre).dot(reduced_costs);
    CHECK((after.row(k) - before.row(k) - share * d).norm() < 1e-14);
  }
  const StructuredShape table = structures::table();
  Points lifted = table.shape.vertices;
  lifted.row(0).z() += 0.5;
  const std::vector<Primitive> primitives = detail::CarriedPrimitives(table).at(lifted);
  for (std::size_t part = 1; part < primitives.size(); ++part)
    CHECK(same_primitive(primitives[part], table.structure.parts[part].primitive));
  CHECK_FALSE(same_primitive(primitives[0], table.structure.parts[0].primitive));
}

TEST_CASE("the surface model carries primitives with the shape") {
  const auto space = deformation_model(structures::mug(), {DeformationKind::surface, Direction(0, 0, 1)});
  const Design design = space->edited(space->at_rest(), {whole_shape, Scale{0.5, z_axis}}, {}).design;
  const Range now = range_along(design.shape, z_axis), before = range_along(space->rest().shape, z_axis);
  CHECK(now.length() == Approx(before.length() / 2));
  for (std::size_t part = 0; part < design.primitives.size(); ++part) {
    const auto& rest = std::get<GeneralizedCylinder>(space->rest().structure.parts[part].primitive);
    const auto& cylinder = std::get<GeneralizedCylinder>(design.primitives[part]);
    const Eigen::VectorXd heights =
        (rest.centres.col(2).array() - before.low - before.length() / 2) / 2 + now.low + now.length() / 2;
    CHECK((cylinder.centres.col(2) - heights).cwiseAbs().maxCoeff() < 1e-9);
    CHECK((cylinder.centres.leftCols<2>() - rest.centres.leftCols<2>()).cwiseAbs().maxCoeff() < 1e-9);
  }
}
