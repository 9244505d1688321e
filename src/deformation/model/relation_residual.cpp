#include "stackabilization/deformation/relation_residual.h"

#include <cmath>

#include "deformation/model/joint_slides.h"
#include "deformation/model/transfer.h"
#include "stackabilization/core/errors.h"
#include "structure/model/correspondence.h"

namespace stackabilization {

namespace {

/// Like std::max, but keeps a distance that is not a number.
void widen(double& gap, double distance) {
  if (!std::isnan(gap) && !(distance <= gap)) gap = distance;
}

double symmetry_gap(const Relation& relation, const Structure& rest, const std::vector<Primitive>& deformed) {
  const auto a = static_cast<std::size_t>(relation.parts.front());
  const auto b = static_cast<std::size_t>(relation.parts.back());
  const Eigen::Isometry3d map = isometry_of(relation.symmetry);
  const std::vector<int> order =
      control_correspondence(rest.parts[a].primitive, rest.parts[b].primitive, map);
  if (order.empty())
    throw InputError("the primitives of '" + rest.parts[a].name + "' and '" + rest.parts[b].name +
                     "' cannot be symmetric: they differ in kind or in their number of cross-sections");
  const Points from = control_points(deformed[a]), to = control_points(deformed[b]);
  double gap = 0;
  for (Eigen::Index i = 0; i < from.rows(); ++i) {
    const Eigen::Vector3d image = map * from.row(i).transpose();
    widen(gap, (image - to.row(order[static_cast<std::size_t>(i)]).transpose()).norm());
  }
  if (const auto* cylinder = std::get_if<GeneralizedCylinder>(&deformed[a])) {
    const Eigen::VectorXd& radii = std::get<GeneralizedCylinder>(deformed[b]).radii;
    for (Eigen::Index i = 0; i < from.rows(); ++i)
      widen(gap, std::abs(cylinder->radii(i) - radii(order[static_cast<std::size_t>(i)])));
  }
  return gap;
}

double joint_gap(const Relation& relation, const Structure& rest, const std::vector<Primitive>& deformed) {
  double gap = 0;
  for (Eigen::Index i = 0; i < relation.points.rows(); ++i) {
    const auto place = [&](int part) {
      const auto k = static_cast<std::size_t>(part);
      return deform_point(rest.parts[k].primitive, deformed[k], relation.points.row(i).transpose());
    };
    const Eigen::Vector3d apart = place(relation.parts[0]) - place(relation.parts[1]);
    widen(
        gap,
        relation.carrier < 0
            ? apart.norm()
            : (detail::held_directions(deformed[static_cast<std::size_t>(relation.carrier)]) * apart).norm());
  }
  return gap;
}

}  // namespace

std::vector<double> relation_residuals(const Structure& rest, const std::vector<Primitive>& deformed) {
  std::vector<double> residuals;
  for (const Relation& relation : rest.relations) {
    const bool joint =
        relation.type == RelationType::point_joint || relation.type == RelationType::line_joint;
    const double gap = joint ? joint_gap(relation, rest, deformed) : symmetry_gap(relation, rest, deformed);
    residuals.push_back(gap / rest.diagonal);
  }
  return residuals;
}

}  // namespace stackabilization
