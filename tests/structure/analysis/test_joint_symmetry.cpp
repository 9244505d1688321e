#include "structure/analysis/joint_symmetry.h"
#include "support/catch.h"

using namespace stackabilization;

namespace {

Relation point(int a, int b, const Eigen::RowVector3d& at) {
  return {.type = RelationType::point_joint, .parts = {a, b}, .symmetry = {}, .points = at};
}

/// A seat mirrored in x and y with two legs that x swaps and y keeps.
Structure bench() {
  Structure structure;
  structure.diagonal = 10;
  for (const char* name : {"seat", "left", "right"}) structure.parts.push_back({name, cuboid_of({}), {}});
  const Symmetry x{.axis = Eigen::Vector3d::UnitX()}, y{.axis = Eigen::Vector3d::UnitY()};
  structure.relations = {{.type = RelationType::self_symmetry, .parts = {0}, .symmetry = x, .points = {}},
                         {.type = RelationType::self_symmetry, .parts = {0}, .symmetry = y, .points = {}},
                         {.type = RelationType::symmetry, .parts = {1, 2}, .symmetry = x, .points = {}},
                         {.type = RelationType::self_symmetry, .parts = {1}, .symmetry = y, .points = {}}};
  return structure;
}

}  // namespace

TEST_CASE("joints that are nearly images of each other become exactly so, on the plane that keeps them") {
  const std::vector<Relation> joints =
      detail::symmetric_joints({point(0, 1, {-3, 0.02, 4}), point(0, 2, {3.04, -0.1, 4.02})}, bench());
  REQUIRE(joints.size() == 2);
  CHECK((joints[0].points - Eigen::RowVector3d(-3.02, 0, 4.01)).norm() < 1e-14);
  CHECK((joints[1].points - Eigen::RowVector3d(3.02, 0, 4.01)).norm() < 1e-14);
}

TEST_CASE("an image that nobody found is added, one of the other type takes the type of the first") {
  std::vector<Relation> joints = detail::symmetric_joints({point(0, 1, {-3, 1, 4})}, bench());
  REQUIRE(joints.size() == 4);  // left at y = 1 and -1, and right where y is not known to keep it
  CHECK(joints[1].parts == std::vector<int>{0, 2});
  CHECK((joints[1].points - Eigen::RowVector3d(3, 1, 4)).norm() < 1e-14);

  Relation line = point(0, 1, {-3, 1, 4});
  line.type = RelationType::line_joint;
  line.points = (Points(2, 3) << -3, -1, 4, -3, 1.1, 4).finished();
  joints = detail::symmetric_joints({line, point(0, 2, {3, 0.1, 4})}, bench());
  REQUIRE(joints.size() == 2);
  for (int k = 0; k < 2; ++k) {
    CHECK(joints[static_cast<std::size_t>(k)].type == RelationType::line_joint);
    const Points& ends = joints[static_cast<std::size_t>(k)].points;
    CHECK((ends.col(0).array() - (k == 0 ? -3 : 3)).abs().maxCoeff() < 1e-14);
    CHECK(ends(0, 1) == Approx(-ends(1, 1)));
    CHECK(ends.col(1).maxCoeff() == Approx(1.05));
  }
}

TEST_CASE(
    "a line whose image was found as two points has one line for its image, and every joint its points") {
  Relation line = point(0, 1, {-3, 0, 4});
  line.type = RelationType::line_joint;
  line.points = (Points(2, 3) << -3, -0.1, 4, -3, 0.1, 4).finished();
  const Relation near = point(0, 2, {3, -0.01, 4}), far = point(0, 2, {3, 0.02, 4});
  for (const std::vector<Relation>& found : {std::vector{line, near, far}, std::vector{near, far, line}}) {
    int lines_right = 0;
    for (const Relation& joint : detail::symmetric_joints(found, bench())) {
      CHECK(joint.points.rows() == (joint.type == RelationType::line_joint ? 2 : 1));
      if (joint.type == RelationType::line_joint && joint.parts[1] == 2) ++lines_right;
    }
    CHECK(lines_right == (found[0].type == RelationType::line_joint ? 1 : 0));
  }
}

TEST_CASE("joints of parts that no symmetry moves stay as they are") {
  Structure structure = bench();
  structure.relations.resize(1);
  const std::vector<Relation> joints = detail::symmetric_joints({point(0, 1, {-3, 0.02, 4})}, structure);
  REQUIRE(joints.size() == 1);
  CHECK(joints[0].points == Eigen::RowVector3d(-3, 0.02, 4));
}
