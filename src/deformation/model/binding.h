#pragma once

#include <Eigen/Core>
#include <variant>
#include <vector>

#include "deformation/model/hollow_box.h"
#include "deformation/model/mean_value_coordinates.h"
#include "deformation/model/skinning.h"

namespace stackabilization::detail {

/// A point bound to a solid cuboid.
struct CageBinding {
  Eigen::Vector3d point;                ///< position at rest
  Eigen::Matrix<double, 8, 1> weights;  ///< mean value coordinates, in the order of Cuboid::corners
};

using PointBinding = std::variant<CageBinding, HollowBoxBinding, CurveBinding>;

/// Derivatives of the position of a bound point with respect to the controls of its primitive; only the
/// blocks that are not zero.
struct ControlJacobian {
  struct ByPoint {
    int point;  ///< control point
    Eigen::Matrix3d block;
  };
  struct ByRadius {
    int section;
    Eigen::Vector3d column;
  };
  std::vector<ByPoint> points;
  std::vector<ByRadius> radii;
  /// Derivative by the rotation vector of a generalized cylinder.
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();
};

/// A primitive at rest to which points are bound. Immutable, safe to share between threads.
class PrimitiveBinding {
 public:
  explicit PrimitiveBinding(const Primitive& rest);

  const Primitive& rest() const { return rest_; }
  /// Returns the binding of a point at rest, model units.
  PointBinding bind(const Eigen::Vector3d& point) const;
  /// Returns the bindings of n points. They equal those of the points one by one.
  std::vector<PointBinding> bind(const Points& points) const;
  /// Returns the position of a bound point for the primitive `now`. Precondition, here and below: `now` has
  /// the kind and size of `rest()`.
  Eigen::Vector3d position_of(const PointBinding& binding, const Primitive& now) const;
  /// Returns the n x 3 displacements of bound points since rest: `carried` minus the point at rest. They are
  /// exactly zero where a solid cuboid did not move.
  Points displacements(const std::vector<PointBinding>& bindings, const Primitive& now) const;
  /// Computes the derivatives of `carried` at `now`. Exact for cuboids; for generalized cylinders, forward
  /// differences over the four sections that influence the point.
  ControlJacobian jacobian(const PointBinding& binding, const Primitive& now) const;

 private:
  Primitive rest_;
  std::variant<std::monostate, CurveAtRest, HollowBoxAtRest> at_rest_;  ///< nothing for a solid cuboid
};

}  // namespace stackabilization::detail
