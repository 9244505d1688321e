#include "deformation/controllers/rig.h"

#include <Eigen/Eigenvalues>

#include "deformation/controllers/joint_copies.h"
#include "deformation/controllers/reduced_basis.h"
#include "deformation/controllers/row_points.h"
#include "deformation/controllers/straightness.h"
#include "stackabilization/deformation/tolerances.h"

namespace stackabilization::detail {

namespace {

/// Projects `basis` to the invariant subspace of the class and merges dependent columns: B' with the fewest
/// columns such that B' B'^T = B B^T. The steps of the solver depend on this product alone.
Eigen::MatrixXd invariant_basis(const ControlSpace& space, int of_class, const Eigen::MatrixXd& basis) {
  const Eigen::MatrixXd columns = space.invariant_columns(of_class, basis);
  if (space.stabilisers(of_class).empty()) return columns;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(columns * columns.transpose());
  const Eigen::VectorXd& strength = solver.eigenvalues();
  Eigen::Index first = 0;
  while (first < strength.size() && strength(first) <= tolerance::redundant * strength.maxCoeff()) ++first;
  const Eigen::Index count = strength.size() - first;
  return space.invariant_columns(
      of_class, solver.eigenvectors().rightCols(count) * strength.tail(count).cwiseSqrt().asDiagonal());
}

}  // namespace

Rig::Rig(const Structure& structure, Following following) : rest(structure), space(structure) {
  for (const Part& part : rest.parts) primitive_bindings.emplace_back(part.primitive);
  for (std::size_t k = 0; k < rest.relations.size(); ++k) {
    const Relation& relation = rest.relations[k];
    if (!relation.is_joint()) continue;
    const std::array<int, 2> parts = {relation.parts[0], relation.parts[1]};
    for (int i = 0; i < relation.points.rows(); ++i) {
      const auto bind = [&](int part) {
        return primitive_bindings[static_cast<std::size_t>(part)].bind(
            Eigen::Vector3d(relation.points.row(i).transpose()));
      };
      joints.push_back({static_cast<int>(k), i, parts, {bind(parts[0]), bind(parts[1])}});
    }
  }
  for (int c = 0; c < space.class_count(); ++c) {
    const Primitive& first = space.rest(space.members(c).front());
    const Eigen::MatrixXd half = space.invariant_columns(c, edit_kernel(first));
    edit_kernels.push_back(space.invariant_columns(c, half.transpose()));
    strains.push_back(strain_scale(first, rest.diagonal));
    bases.push_back(invariant_basis(space, c, reduced_basis(first, strains.back(), following)));
    free_bases.push_back(
        following == Following::free
            ? bases.back()
            : invariant_basis(space, c, reduced_basis(first, strains.back(), Following::free)));
    const auto* cylinder = std::get_if<GeneralizedCylinder>(&first);
    slides.push_back(cylinder && !cylinder->closed ? slide_functions(*cylinder) : Eigen::MatrixXd());
    // Castors and knobs are bought, not made: their sections stay where they are.
    if (following == Following::smooth && strains.back() < 1) slides.back().resize(slides.back().rows(), 0);
    turnings.push_back(cylinder ? turning(*cylinder) : Eigen::MatrixXd());
  }
  distinct_joints = detail::distinct_joints(*this);
  if (following == Following::smooth) row_points = detail::row_points(*this);
}

}  // namespace stackabilization::detail
