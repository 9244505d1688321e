#include "deformation/carried/carried_primitives.h"

#include <Eigen/Geometry>
#include <Eigen/QR>

#include "deformation/controllers/extent_bounds.h"
#include "deformation/controllers/part_edit.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {

namespace {

/// Returns the pseudo-inverse of the m x 3 matrix `offsets`, 3 x m. Empty unless its rows span space.
Eigen::MatrixXd spanning_pseudo_inverse(const Points& offsets) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
  solver.setThreshold(tolerance::relative);
  solver.compute(offsets);
  return solver.rank() < 3 ? Eigen::MatrixXd() : Eigen::MatrixXd(solver.pseudoInverse());
}

/// Displacement of a control point: p -> p + strain (p - centre) + shift.
struct Displacements {
  Eigen::Matrix3d strain = Eigen::Matrix3d::Zero();
  Eigen::Vector3d centre, shift;
};

Primitive moved(Primitive primitive, const Displacements& by) {
  const auto move = [&](auto& points) {
    for (Eigen::Index i = 0; i < points.rows(); ++i)
      points.row(i) += (by.strain * (points.row(i).transpose() - by.centre) + by.shift).transpose();
  };
  if (auto* cuboid = std::get_if<Cuboid>(&primitive)) {
    move(cuboid->corners);
    return primitive;
  }
  auto& cylinder = std::get<GeneralizedCylinder>(primitive);
  if (!by.strain.isZero(0)) {
    const Eigen::Matrix3d linear = Eigen::Matrix3d::Identity() + by.strain;
    cylinder.radii.array() *= radius_factors(cylinder, linear).array();
    cylinder.rotation = Eigen::Quaterniond(Eigen::Affine3d(linear).rotation()) * cylinder.rotation;
  }
  move(cylinder.centres);
  return primitive;
}

Points rows_of(const Points& points, const std::vector<int>& rows) {
  Points some(static_cast<Eigen::Index>(rows.size()), 3);
  for (std::size_t i = 0; i < rows.size(); ++i) some.row(static_cast<Eigen::Index>(i)) = points.row(rows[i]);
  return some;
}

}  // namespace

CarriedPrimitives::CarriedPrimitives(const StructuredShape& rest) : rest_(rest.shape.vertices) {
  std::vector<std::vector<int>> by_part = vertices_by_part(rest.shape);
  for (std::size_t k = 0; k < rest.structure.parts.size(); ++k) {
    const Points points = rows_of(rest_, by_part[k]);
    const Eigen::RowVector3d centre = points.colwise().mean();
    parts_.push_back({rest.structure.parts[k].primitive, std::move(by_part[k]), centre.transpose(),
                      spanning_pseudo_inverse(points.rowwise() - centre)});
  }
}

std::vector<Primitive> CarriedPrimitives::at(const Points& vertices) const {
  std::vector<Primitive> primitives;
  for (const CarriedPart& part : parts_) {
    const Points moves = rows_of(vertices, part.vertices) - rows_of(rest_, part.vertices);
    primitives.push_back(part.primitive);
    if (moves.isZero(0)) continue;
    Displacements by;
    by.centre = part.centre;
    by.shift = moves.colwise().mean().transpose();
    if (part.pseudo_inverse.size() > 0) by.strain = (part.pseudo_inverse * moves).transpose();
    primitives.back() = moved(part.primitive, by);
  }
  return primitives;
}

}  // namespace stackabilization::detail
