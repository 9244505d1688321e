#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "stackabilization/core/errors.h"
#include "stackabilization/io/read.h"
#include "stackabilization/structure/analysis.h"
#include "stackabilization/structure/project_file.h"
#include "structure/analysis/symmetrize.h"
#include "support/catch.h"
#include "support/messages.h"
#include "support/solids.h"
#include "support/symmetric_solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

int count_of_type(const Structure& structure, RelationType type) {
  return static_cast<int>(std::count_if(structure.relations.begin(), structure.relations.end(),
                                        [&](const Relation& relation) { return relation.type == type; }));
}

double worst_miss(const Structure& structure) {
  double most = 0;
  for (const Relation& relation : structure.relations)
    if (relation.points.rows() == 0) most = std::max(most, detail::symmetry_residual(structure, relation));
  return most;
}

/// Distance from the image of every joint to the nearest joint between the images of its parts.
double worst_joint_miss(const Structure& structure, const Symmetry& plane) {
  std::map<int, int> image;
  for (const Relation& relation : structure.relations)
    if (relation.points.rows() == 0 && relation.symmetry.axis == plane.axis &&
        relation.symmetry.point == plane.point)
      image[relation.parts.front()] = relation.parts.back(),
      image[relation.parts.back()] = relation.parts.front();
  double most = 0;
  for (const Relation& joint : structure.relations) {
    if (joint.points.rows() == 0 || image.count(joint.parts[0]) + image.count(joint.parts[1]) < 2) continue;
    const std::vector<int> parts = {std::min(image[joint.parts[0]], image[joint.parts[1]]),
                                    std::max(image[joint.parts[0]], image[joint.parts[1]])};
    double nearest = 1e9;
    for (const Relation& other : structure.relations)
      if (other.type == joint.type && other.parts == parts)
        nearest = std::min(
            nearest,
            (isometry_of(plane) * joint.points.row(0).transpose() - other.points.row(0).transpose()).norm());
    most = std::max(most, nearest);
  }
  return most;
}

}  // namespace

TEST_CASE("a table: five parts, four pairs, four point joints, all exactly symmetric") {
  const StructuredShape table = analyse_structure(solids::table({}));
  const Structure& structure = table.structure;
  validate(table);
  CHECK(structure.parts.size() == 5);
  CHECK(structure.diagonal == Approx(std::sqrt(64 + 64 + 36)));
  CHECK(count_of_type(structure, RelationType::symmetry) >= 4);
  CHECK(count_of_type(structure, RelationType::point_joint) == 4);
  CHECK(count_of_type(structure, RelationType::line_joint) == 0);
  CHECK(worst_miss(structure) < 1e-13 * 12);
  for (const Symmetry& plane : structure.symmetries)
    if (plane.kind == SymmetryKind::reflection) CHECK(worst_joint_miss(structure, plane) < 1e-13 * 12);
  for (const Part& part : structure.parts) CHECK(std::holds_alternative<Cuboid>(part.primitive));
}

TEST_CASE("a chair in an odd pose with noise: relations hold exactly between the primitives") {
  solids::Random random(12);
  Shape chair = transformed(solids::chair(),
                            Eigen::AngleAxisd(0.9, Eigen::Vector3d(3, -1, 2).normalized()).toRotationMatrix(),
                            {4, 5, -6});
  for (Eigen::Index v = 0; v < chair.vertex_count(); ++v)
    chair.vertices.row(v) += 0.01 * random.in_cube().transpose();
  const StructuredShape result = analyse_structure(chair);
  CHECK(count_of_type(result.structure, RelationType::symmetry) >= 2);
  CHECK(count_of_type(result.structure, RelationType::point_joint) +
            count_of_type(result.structure, RelationType::line_joint) >=
        5);
  CHECK(worst_miss(result.structure) < 1e-12 * result.structure.diagonal);
}

TEST_CASE("a cup with handle: two point joints in the plane of the handle") {
  const StructuredShape cup = analyse_structure(solids::cup_with_handle());
  REQUIRE(cup.structure.parts.size() == 2);
  CHECK(std::holds_alternative<GeneralizedCylinder>(cup.structure.parts[0].primitive));
  CHECK(std::holds_alternative<GeneralizedCylinder>(cup.structure.parts[1].primitive));
  CHECK(count_of_type(cup.structure, RelationType::point_joint) == 2);
  for (const Relation& relation : cup.structure.relations)
    if (relation.type == RelationType::point_joint) CHECK(relation.points(0, 1) == Approx(0).margin(1e-12));
  CHECK(worst_miss(cup.structure) < 1e-13 * cup.structure.diagonal);
}

TEST_CASE("kinds can be forced, for all symmetric parts alike") {
  AnalysisOptions options;
  options.kinds = {{"leg_2", PrimitiveKind::cylinder}};
  const StructuredShape table = analyse_structure(solids::table({}), options);
  for (const Part& part : table.structure.parts)
    CHECK(std::holds_alternative<GeneralizedCylinder>(part.primitive) == (part.name != "top"));
  options.kinds["leg_1"] = PrimitiveKind::cuboid;
  CHECK_THROWS_AS(analyse_structure(solids::table({}), options), UsageError);
  options.kinds = {{"arm", PrimitiveKind::cuboid}};
  CHECK_THROWS_AS(analyse_structure(solids::table({}), options), UsageError);
}

TEST_CASE("a structure scales with the shape, to the bit") {
  for (const std::string model : {"armchair", "mug_with_handle"}) {
    const Shape shape =
        read_shape(std::filesystem::path(STACKABILIZATION_SOURCE_DIR) / "data/models" / (model + ".obj"));
    const Structure expected = analyse_structure(shape).structure;
    for (const int exponent : {-10, 10}) {  // metres as kilometres, and nearly as millimetres
      Shape scaled = shape;
      scaled.vertices *= std::exp2(exponent);
      const Structure found = analyse_structure(scaled).structure;
      REQUIRE(found.parts.size() == expected.parts.size());
      for (std::size_t p = 0; p < found.parts.size(); ++p) {
        REQUIRE(found.parts[p].primitive.index() == expected.parts[p].primitive.index());
        CHECK(control_points(found.parts[p].primitive) ==
              std::exp2(exponent) * control_points(expected.parts[p].primitive));
      }
      REQUIRE(found.relations.size() == expected.relations.size());
      for (std::size_t k = 0; k < found.relations.size(); ++k) {
        const Relation &one = found.relations[k], &other = expected.relations[k];
        CHECK(one.type == other.type);
        CHECK(one.parts == other.parts);
        CHECK(one.residual == other.residual);
        CHECK(one.points == std::exp2(exponent) * other.points);
      }
    }
  }
}

TEST_CASE("the same structure comes out for any number of threads") {
  const std::string many = project_text(analyse_structure(solids::chair()));
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  CHECK(project_text(analyse_structure(solids::chair())) == many);
}

TEST_CASE("what is no shape has no structure") {
  CHECK_THROWS_AS(analyse_structure(Shape{}), InputError);
}

TEST_CASE("a part without area is refused by its name, for every way in which it stays a part") {
  Triangles triangles(1, 3);
  triangles << 0, 1, 2;
  const Shape line = make_shape((Points(3, 3) << 0, 0, 0, 0, 0, 1, 0, 0, 2).finished(), triangles);
  const Shape shape =
      concatenate(solids::named(solids::box({0, 0, 0}, {1, 1, 2}), "body"), solids::named(line, "wire"));
  AnalysisOptions options;
  for (const SegmentationMethod method :
       {SegmentationMethod::automatic, SegmentationMethod::members, SegmentationMethod::given}) {
    options.segmentation.method = method;
    CHECK(message_of<InputError>([&] { analyse_structure(shape, options); }) ==
          "part 'wire' has no triangle of positive area");
  }
  options.segmentation.method = SegmentationMethod::components;
  CHECK(analyse_structure(shape, options).structure.parts.size() == 1);
}

namespace {

/// A box of which one side is missing, so that its surface is open.
Shape open_panel(const Eigen::Vector3d& lowest, const Eigen::Vector3d& highest, const std::string& name) {
  return solids::named(solids::open_box(lowest, highest), name);
}

/// Two sides, three boards and a back that touch in faces, all `thickness` thick.
Shape open_shelf(double thickness) {
  const double t = thickness;
  Shape shelf = open_panel({0, 0, 0}, {t, 1, 3}, "left");
  const auto add = [&](const Eigen::Vector3d& lowest, const Eigen::Vector3d& highest,
                       const std::string& name) {
    shelf = concatenate(shelf, open_panel(lowest, highest, name));
  };
  add({2 - t, 0, 0}, {2, 1, 3}, "right");
  for (const int level : {0, 1, 2})
    add({t, 0, 1.25 * level}, {2 - t, 1, 1.25 * level + t}, "board " + std::to_string(level));
  add({0, 1, 0}, {2, 1 + t, 3}, "back");
  return shelf;
}

}  // namespace

TEST_CASE("a shelf of six thin open panels has a structure, however thin they are and in every pose") {
  Eigen::Matrix3d cyclic;
  cyclic << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  const std::vector<Eigen::Matrix3d> poses = {Eigen::Matrix3d::Identity(), cyclic, solids::random_rotation(1),
                                              solids::random_rotation(2)};
  for (const double thickness : {0.02, 1e-4, 8e-9, 3e-9, 1e-9, 1e-12, 0.0})
    for (const Eigen::Matrix3d& pose : poses) {
      INFO(thickness);
      const StructuredShape shelf =
          analyse_structure(transformed(open_shelf(thickness), pose, pose * Eigen::Vector3d(0.1, 0.2, 0.3)));
      validate(shelf);
      CHECK(shelf.structure.parts.size() == 6);
      CHECK(std::count_if(shelf.structure.relations.begin(), shelf.structure.relations.end(),
                          [](const Relation& relation) { return relation.points.rows() > 0; }) >= 8);
    }
}
