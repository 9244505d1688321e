#include "deformation/controllers/seam_end.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <variant>

#include "stackabilization/core/tolerances.h"
#include "structure/model/nearest_box.h"

namespace stackabilization::detail {

namespace {

Eigen::AlignedBox3d box_of(const Points& points, const Eigen::Matrix3d& axes) {
  const Points turned = points * axes;
  return {turned.colwise().minCoeff().transpose(), turned.colwise().maxCoeff().transpose()};
}

/// Returns how much of the width of a section a seam takes up.
double covered(double seam, double section) {
  return std::min(seam / section, 1.0);
}

SeamEnd end_of(const Cuboid& cuboid, const Points& vertices, const Points& seam) {
  const OrientedBox box = nearest_box(cuboid);
  const Eigen::Vector3d middle = box.axes.transpose() * (seam.colwise().mean().transpose() - box.centre);
  const Eigen::Vector3d widths = box_of(seam, box.axes).sizes(), whole = box_of(vertices, box.axes).sizes();
  const double flat = tolerance::relative * whole.norm();
  SeamEnd end;
  for (int axis = 0; axis < 3; ++axis) {
    const double half = box.half_extents(axis);
    if (!(half > flat)) continue;
    double share = std::min(std::abs(middle(axis)) / half, 1.0);
    for (const int side : {(axis + 1) % 3, (axis + 2) % 3})
      if (whole(side) > flat) share *= covered(widths(side), 2 * box.half_extents(side));
    if (share > end.share) end = {share, (middle(axis) > 0 ? -1 : 1) * box.axes.col(axis)};
  }
  return end;
}

SeamEnd end_of(const GeneralizedCylinder& cylinder, const Points& seam) {
  Eigen::Index nearest = 0;
  (cylinder.centres.rowwise() - seam.colwise().mean()).rowwise().squaredNorm().minCoeff(&nearest);
  Eigen::Matrix3d axes;
  axes.col(0) = section_tangents(cylinder).row(nearest).transpose();
  axes.col(1) = axes.col(0).unitOrthogonal();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  const Eigen::VectorXd lengths = section_arc_lengths(cylinder);
  const double whole = lengths(lengths.size() - 1), place = 2 * lengths(nearest) / whole - 1;
  SeamEnd end{0, (place > 0 ? -1 : 1) * axes.col(0)};
  if (cylinder.closed) return end;
  const Eigen::Vector3d widths = box_of(seam, axes).sizes();
  const double section = 2 * cylinder.radii(nearest);
  end.share = std::abs(place) * covered(widths(1), section) * covered(widths(2), section);
  return end;
}

}  // namespace

SeamEnd seam_end(const Primitive& primitive, const Points& vertices, const Points& seam) {
  if (const auto* cuboid = std::get_if<Cuboid>(&primitive)) return end_of(*cuboid, vertices, seam);
  return end_of(std::get<GeneralizedCylinder>(primitive), seam);
}

}  // namespace stackabilization::detail
