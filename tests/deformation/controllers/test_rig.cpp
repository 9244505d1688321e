#include <Eigen/SVD>
#include <cmath>
#include <map>
#include <numbers>

#include "deformation/controllers/joint_copies.h"
#include "deformation/controllers/reduced_basis.h"
#include "deformation/controllers/relation_solver.h"
#include "deformation/controllers/rig.h"
#include "support/catch.h"
#include "support/structures.h"

using namespace stackabilization;
using namespace stackabilization::detail;

TEST_CASE("joints that symmetries take onto each other are solved for once") {
  // Four legs at the top; two pairs of bars, each pair with four legs' ends.
  const Rig rig(structures::table().structure);
  REQUIRE(rig.joints.size() == 12);
  CHECK(rig.distinct_joints == std::vector<int>{0, 4, 6});
  CHECK(joint_constraints(rig).size() == 3);
  // Those of the mug lie in its mirror plane.
  CHECK(Rig(structures::mug().structure).distinct_joints == std::vector<int>{0, 1});
  // A line joint has two points, above each other: no symmetry of the table swaps them.
  CHECK(Rig(structures::table_with_line_joints().structure).distinct_joints.size() == 5);
}

TEST_CASE("without relations between parts every joint is its own") {
  Structure structure = structures::table().structure;
  std::vector<Relation> joints;
  for (const Relation& relation : structure.relations)
    if (relation.type == RelationType::point_joint) joints.push_back(relation);
  structure.relations = joints;
  CHECK(Rig(structure).distinct_joints.size() == 12);
}

TEST_CASE("a joint that is moved away from its mirror image is no copy of another") {
  Structure structure = structures::table().structure;
  for (Relation& relation : structure.relations)
    if (relation.type == RelationType::point_joint && relation.parts == std::vector<int>{0, 2})
      relation.points(0, 0) += 0.01;
  const Rig rig(structure);
  // Of the four joints at the top, mirror images of each other in pairs, one is left out of its pairs.
  CHECK(rig.distinct_joints == std::vector<int>{0, 1, 4, 6});
}

TEST_CASE("bases hold what self-symmetries leave, in as few columns as that takes") {
  for (const StructuredShape& rest : {structures::table(), structures::mug(), structures::post_with_ring()}) {
    const Rig rig(rest.structure);
    for (int c = 0; c < rig.space.class_count(); ++c) {
      const Eigen::MatrixXd& basis = rig.bases[static_cast<std::size_t>(c)];
      const Primitive& first = rig.space.rest(rig.space.members(c).front());
      const double strain = rig.strains[static_cast<std::size_t>(c)];
      const Eigen::MatrixXd all = rig.space.invariant_columns(c, reduced_basis(first, strain));
      const Eigen::MatrixXd wanted = all * all.transpose(), found = basis * basis.transpose();
      CHECK((found - wanted).norm() < 1e-9 * wanted.norm());
      CHECK((rig.space.invariant_columns(c, basis) - basis).norm() < 1e-12 * basis.norm());
    }
  }
  // A box with two mirror planes keeps 24 / 4 freedoms, a leg that has images instead keeps all.
  const Rig table(structures::table().structure);
  CHECK(table.bases[static_cast<std::size_t>(table.space.class_of(0))].cols() == 6);
  CHECK(table.bases[static_cast<std::size_t>(table.space.class_of(1))].cols() == 24);
}

TEST_CASE("an affine motion of a tube costs its strain, however little the tube leaves a plane") {
  // Half a ring. Its centres leave their plane by `height`, up and down in turns, as those of a scanned
  // handle do.
  const auto handle = [](double height) {
    GeneralizedCylinder tube;
    tube.centres.resize(9, 3);
    tube.radii = Eigen::VectorXd::Constant(9, 0.1);
    for (int k = 0; k < 9; ++k) {
      const double angle = std::numbers::pi * k / 8;
      tube.centres.row(k) << std::cos(angle), std::sin(angle), k % 2 == 0 ? height : -height;
    }
    return tube;
  };
  // Products of the columns of the affine motions along x: 1 + n C C^T / s^2, where the singular value s is
  // the largest of the centred positions C.
  const auto products = [](const GeneralizedCylinder& tube) -> Eigen::MatrixXd {
    const Eigen::MatrixXd basis = reduced_basis(tube, 1, Following::smooth);
    Eigen::MatrixXd rows(9, basis.cols());
    for (int k = 0; k < 9; ++k) rows.row(k) = basis.row(3 * k);
    return rows * rows.transpose();
  };
  for (const double height : {0.0, 1e-9, 1e-6, 1e-3, 0.3}) {
    const GeneralizedCylinder tube = handle(height);
    const Eigen::MatrixXd centred = tube.centres.rowwise() - tube.centres.colwise().mean();
    const double largest = Eigen::JacobiSVD<Eigen::MatrixXd>(centred).singularValues()(0);
    const Eigen::MatrixXd wanted =
        Eigen::MatrixXd::Ones(9, 9) + 9 * centred * centred.transpose() / (largest * largest);
    CAPTURE(height);
    CHECK((products(tube) - wanted).norm() < 1e-12);
  }
}

TEST_CASE("small parts of smooth designs do not slide within themselves") {
  Structure structure =
      structures::tube_alone(structures::straight_cylinder({0, 0, 0}, {0, 0, 1}, 0.1, 6), 12).structure;
  CHECK(Rig(structure, Following::smooth).slides[0].cols() == 4);
  structure.diagonal = 20;  // as of a part of something larger
  CHECK(Rig(structure, Following::smooth).slides[0].cols() == 0);
  CHECK(Rig(structure, Following::free).slides[0].cols() == 4);
}
