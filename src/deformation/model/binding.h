#pragma once

#include <Eigen/Core>
#include <variant>
#include <vector>

#include "deformation/model/mean_value_coordinates.h"
#include "deformation/model/skinning.h"

namespace stackabilization::detail {

/// A point that rides on a cuboid.
struct CageBinding {
  Eigen::Vector3d point;                ///< at rest
  Eigen::Matrix<double, 8, 1> weights;  ///< mean value coordinates
};

using PointBinding = std::variant<CageBinding, CurveBinding>;

/// How a carried point moves with the controls of its primitive: the blocks that are not zero.
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
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();  ///< by the rotation vector of a generalized cylinder
};

/// A primitive at rest that carries points. Immutable, safe to share between threads.
class Carrier {
 public:
  explicit Carrier(const Primitive& rest);

  const Primitive& rest() const { return rest_; }
  PointBinding bind(const Eigen::Vector3d& point) const;
  /// n bindings of n points: the same as one by one.
  std::vector<PointBinding> bind(const Points& points) const;
  /// Precondition, here and below: `now` is of the kind and size of `rest()`.
  Eigen::Vector3d carried(const PointBinding& binding, const Primitive& now) const;
  /// Displacements of bound points since rest, n x 3: `carried` minus the point, and exactly zero where the
  /// cuboid did not move.
  Points displacements(const std::vector<PointBinding>& bindings, const Primitive& now) const;
  /// Exact for cuboids; forward differences over the four sections that matter for generalized cylinders.
  ControlJacobian jacobian(const PointBinding& binding, const Primitive& now) const;

 private:
  Primitive rest_;
  std::variant<std::monostate, CurveAtRest> curve_;
};

}  // namespace stackabilization::detail
