#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "stackabilization/structure/primitive.h"

namespace stackabilization {

/// A rigid motion p -> R p + t as a unit dual quaternion.
struct DualQuaternion {
  Eigen::Quaterniond real = Eigen::Quaterniond::Identity();  ///< R
  Eigen::Quaterniond dual = Eigen::Quaterniond(0, 0, 0, 0);  ///< t R / 2
};

/// Precondition: `rotation` is of unit length.
DualQuaternion dual_quaternion(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& translation);

/// Dual quaternion linear blending (Kavan et al. 2007) of two rigid motions, 0 <= `fraction` <= 1 towards
/// `b`, along the shorter way, applied to `point`. Exact up to rounding where both are the same.
Eigen::Vector3d blended(const DualQuaternion& a, const DualQuaternion& b, double fraction,
                        const Eigen::Vector3d& point);

/// The rotation by the smallest angle that takes the unit vector `from` to the unit vector `to`; the
/// identity, bit for bit, when they are the same. Opposite vectors: some half turn.
Eigen::Quaterniond smallest_rotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// Where a point rides on the curve of a generalized cylinder: between two neighbouring sections, in the
/// plane across the curve, or beyond an open end.
struct CurveBinding {
  int from = 0, to = 1;    ///< sections
  double fraction = 0;     ///< 0 at `from`, 1 at `to`
  Eigen::Vector3d axis;    ///< the point of the curve, relative to the origin of the rest
  Eigen::Vector3d radial;  ///< from there to the point, across the curve; scales with the radius
  Eigen::Vector3d axial;   ///< beyond an open end: along the curve, scales with its last piece; 0 elsewhere
};

/// A generalized cylinder at rest with what every binding needs.
class CurveAtRest {
 public:
  /// Precondition: `validate(cylinder, name)` passes.
  explicit CurveAtRest(GeneralizedCylinder cylinder);

  const GeneralizedCylinder& cylinder() const { return cylinder_; }  ///< the one given
  /// Mean of the centres: motions are expressed relative to it, which keeps digits far from the origin.
  const Eigen::Vector3d& origin() const { return origin_; }

  /// The nearest place of the curve whose cross-section plane holds the point; the planes turn linearly with
  /// the tangents from section to section, so that neighbouring points get neighbouring places, and each
  /// section carries its own plane.
  CurveBinding bind(const Eigen::Vector3d& point) const;

  /// Rigid motion of section `i` (relative to the origin on both sides) when the cylinder becomes `now`: its
  /// centre and tangent follow those of `now`, with as little turning about the tangent as the rotation of
  /// the whole allows.
  DualQuaternion motion(const GeneralizedCylinder& now, int i) const;

  /// Where the bound point goes, given the motions of its two sections.
  Eigen::Vector3d carried(const CurveBinding& binding, const GeneralizedCylinder& now,
                          const DualQuaternion& from, const DualQuaternion& to) const;
  /// The same with the motions that `motion` gives.
  Eigen::Vector3d carried(const CurveBinding& binding, const GeneralizedCylinder& now) const {
    return carried(binding, now, motion(now, binding.from), motion(now, binding.to));
  }

 private:
  CurveBinding bound(int piece, double fraction, const Eigen::Vector3d& point) const;
  int pieces() const;

  GeneralizedCylinder cylinder_;
  Points tangents_;
  Eigen::Vector3d origin_;
};

}  // namespace stackabilization
