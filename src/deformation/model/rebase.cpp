#include "stackabilization/deformation/rebase.h"

#include "deformation/model/transfer.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

/// Returns the joint points, each at the mean of the positions to which its parts carry it.
Points settled_points(const Relation& joint, const Structure& rest,
                      const std::vector<Primitive>& primitives) {
  Points points = Points::Zero(joint.points.rows(), 3);
  for (const int row : joint.parts) {
    const auto part = static_cast<std::size_t>(row);
    for (Eigen::Index i = 0; i < points.rows(); ++i)
      points.row(i) +=
          deform_point(rest.parts[part].primitive, primitives[part], joint.points.row(i).transpose())
              .transpose();
  }
  return points / static_cast<double>(joint.parts.size());
}

}  // namespace

StructuredShape rebase(const StructuredShape& rest, const Design& design) {
  if (design.primitives.size() != rest.structure.parts.size())
    throw UsageError("a deformation without primitives has no new structure");
  StructuredShape now{design.shape, rest.structure};
  for (std::size_t part = 0; part < now.structure.parts.size(); ++part) {
    Primitive& primitive = now.structure.parts[part].primitive;
    primitive = design.primitives[part];
    if (auto* const cylinder = std::get_if<GeneralizedCylinder>(&primitive))
      cylinder->rotation = Eigen::Quaterniond::Identity();
  }
  for (Relation& relation : now.structure.relations)
    if (relation.points.rows() > 0)
      relation.points = settled_points(relation, rest.structure, design.primitives);
  const auto length = [&](const Eigen::Vector3d& axis) { return range_along(design.shape, axis).length(); };
  now.structure.diagonal = Eigen::Vector3d(length(Eigen::Vector3d::UnitX()), length(Eigen::Vector3d::UnitY()),
                                           length(Eigen::Vector3d::UnitZ()))
                               .norm();
  return now;
}

}  // namespace stackabilization
