#include "support/still_designs.h"

#include <cmath>
#include <utility>

#include "support/solids.h"
#include "support/structures.h"

namespace stackabilization::designs {

StructuredShape alone(Shape shape, const Primitive& primitive) {
  StructuredShape structured;
  structured.shape = std::move(shape);
  structured.structure.parts = {{structured.shape.part_names[0], primitive, {}}};
  const Points& v = structured.shape.vertices;
  structured.structure.diagonal = (v.colwise().maxCoeff() - v.colwise().minCoeff()).norm();
  return structured;
}

StructuredShape cup() {
  solids::FrustumShell shell;
  shell.inner_bottom = 2.5625;
  return alone(solids::frustum_shell(shell), structures::straight_cylinder({0, 0, 0}, {0, 0, 8}, 4, 5));
}

StructuredShape two_cubes() {
  StructuredShape cubes;
  for (const double x : {-2.0, 1.0}) {
    Shape cube = solids::box({x, 0, 0}, {x + 1, 1, 1});
    cube.part_names = {x < 0 ? "left" : "right"};
    cubes.shape = x < 0 ? cube : concatenate(cubes.shape, cube);
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5);
    cubes.structure.parts.push_back(
        {cube.part_names[0], cuboid_of({{x + 0.5, 0.5, 0.5}, Eigen::Matrix3d::Identity(), half}), {}});
  }
  Relation mirror;
  mirror.parts = {0, 1};
  mirror.symmetry.axis = Eigen::Vector3d::UnitX();
  cubes.structure.relations = {mirror};
  cubes.structure.diagonal = std::sqrt(18.0);
  return cubes;
}

Requirements frame_requirements(double target) {
  Requirements requirements;
  requirements.target = target;
  requirements.measure.boxes = BoxModel::frame;
  return requirements;
}

Design scaled(Design design, const Eigen::Vector3d& factors) {
  design.shape.vertices *= factors.asDiagonal();
  return design;
}

}  // namespace stackabilization::designs
