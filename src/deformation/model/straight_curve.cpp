#include "deformation/model/straight_curve.h"

#include <Eigen/Geometry>

namespace stackabilization::detail {

namespace {

/// Largest distance of a straight curve or profile from its chord, fraction of the length of the chord.
constexpr double straight_enough = 0.02;

}  // namespace

Eigen::Vector3d chord_of(const GeneralizedCylinder& cylinder) {
  return (cylinder.centres.row(cylinder.centres.rows() - 1) - cylinder.centres.row(0)).transpose();
}

Eigen::VectorXd places_along_chord(const GeneralizedCylinder& cylinder) {
  return (cylinder.centres.rowwise() - cylinder.centres.row(0)) * chord_of(cylinder).normalized();
}

bool is_straight(const GeneralizedCylinder& cylinder) {
  if (cylinder.closed) return false;
  const Eigen::Vector3d chord = chord_of(cylinder);
  for (Eigen::Index i = 1; i + 1 < cylinder.centres.rows(); ++i) {
    const Eigen::Vector3d offset = (cylinder.centres.row(i) - cylinder.centres.row(0)).transpose();
    if (!(offset.cross(chord).norm() <= straight_enough * chord.squaredNorm())) return false;
  }
  return true;
}

bool has_straight_wall(const GeneralizedCylinder& cylinder) {
  if (!is_straight(cylinder)) return false;
  const Eigen::VectorXd& radii = cylinder.radii;
  const double first = radii(0), last = radii(radii.size() - 1);
  const Eigen::VectorXd straight =
      first + (last - first) * (places_along_chord(cylinder) / chord_of(cylinder).norm()).array();
  return (radii - straight).cwiseAbs().maxCoeff() <= straight_enough * chord_of(cylinder).norm();
}

}  // namespace stackabilization::detail
