#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "stackabilization/structure/primitive.h"

namespace stackabilization {

/// A rigid motion p -> R p + t as a unit dual quaternion.
struct DualQuaternion {
  Eigen::Quaterniond real = Eigen::Quaterniond::Identity();  ///< rotation R
  Eigen::Quaterniond dual = Eigen::Quaterniond(0, 0, 0, 0);  ///< t R / 2, with t as a pure quaternion
};

/// Converts a rotation and a translation. Precondition: `rotation` has unit length.
DualQuaternion dual_quaternion(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& translation);

/// Applies the dual quaternion linear blend (Kavan et al. 2007) of two rigid motions to `point`, along the
/// shorter way. `fraction`, in [0, 1], is the weight of `b`. Exact up to rounding where both motions are the
/// same.
Eigen::Vector3d blended(const DualQuaternion& a, const DualQuaternion& b, double fraction,
                        const Eigen::Vector3d& point);

/// Returns the rotation by the smallest angle that maps the unit vector `from` to the unit vector `to`. For
/// equal vectors it is the identity bit for bit, for opposite vectors some half turn.
Eigen::Quaterniond smallest_rotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// Position of a bound point relative to the curve of a generalized cylinder: between two neighbouring
/// sections, in the cross-section plane, or beyond an open end.
struct CurveBinding {
  int from = 0, to = 1;    ///< rows of the two sections
  double fraction = 0;     ///< position between the sections: 0 at `from`, 1 at `to`
  Eigen::Vector3d axis;    ///< point of the curve, relative to CurveAtRest::origin
  Eigen::Vector3d radial;  ///< offset from there to the point, across the curve; follows the radius
  /// Offset beyond an open end, along the curve; scales with the last piece of the curve; 0 elsewhere.
  Eigen::Vector3d axial;
};

/// A generalized cylinder at rest, with the data that every binding needs.
class CurveAtRest {
 public:
  /// Points follow the radii in proportion to their distance from the curve, except in the wall of a hollow
  /// body: they move by the change of the radius, so that the wall keeps its thickness. Precondition:
  /// `validate(cylinder, name)` passes.
  explicit CurveAtRest(GeneralizedCylinder cylinder);

  const GeneralizedCylinder& cylinder() const { return cylinder_; }  ///< the given cylinder
  /// Returns the mean of the centres. Motions are relative to it, which keeps digits far from the origin of
  /// the file.
  const Eigen::Vector3d& origin() const { return origin_; }

  /// Binds a point to the nearest position on the curve whose cross-section plane contains the point. The
  /// planes rotate linearly with the tangents from section to section, so neighbouring points have
  /// neighbouring positions, and each section carries its own plane.
  CurveBinding bind(const Eigen::Vector3d& point) const;

  /// Computes the rigid motion of section `i` (relative to the origin on both sides) when the cylinder
  /// becomes `now`. Its centre and tangent follow those of `now`. The rotation about the tangent is as small
  /// as the rotation of the whole allows.
  DualQuaternion motion(const GeneralizedCylinder& now, int i) const;

  /// Returns the position of a bound point, given the motions of its two sections.
  Eigen::Vector3d position_of(const CurveBinding& binding, const GeneralizedCylinder& now,
                              const DualQuaternion& from, const DualQuaternion& to) const;
  /// Returns the position of a bound point, with the motions that `motion` gives.
  Eigen::Vector3d position_of(const CurveBinding& binding, const GeneralizedCylinder& now) const {
    return position_of(binding, now, motion(now, binding.from), motion(now, binding.to));
  }

 private:
  /// Returns the factor by which the distance of a bound point from the curve grows.
  double radial_growth(const CurveBinding& binding, const GeneralizedCylinder& now) const;
  CurveBinding bound(int piece, double fraction, const Eigen::Vector3d& point) const;
  int pieces() const;

  GeneralizedCylinder cylinder_;
  Points tangents_;
  Eigen::Vector3d origin_;
};

}  // namespace stackabilization
