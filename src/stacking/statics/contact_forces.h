#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace stackabilization::detail {

/// A point at which a body is held, and the direction of the force there without friction.
struct Hold {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();   ///< units of length of the body
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, towards the body
};

/// What contact forces make of a pull, per unit of the normal forces together.
struct Grip {
  double resisted = 0;  ///< largest pull that they resist; at most 0: none
  double press = 0;     ///< press that makes the normal forces of that pull
  /// Normal forces of that pull, one per hold; they add up to 1.
  Eigen::VectorXd normal_forces;
};

/// Forces on a rigid body that is held at points with Coulomb friction. z is up. At each hold the forces are
/// those of a pyramid with 32 sides inside the friction cone, one of them straight up or down the surface:
/// across the slope there may be half a per cent less friction. Forces and torques are in balance when they
/// are so to tolerance::force of the weight, decided exactly (maximize).
class ContactForces {
 public:
  /// `friction`: coefficient, >= 0. `mass`: centre of mass of the body.
  ContactForces(const std::vector<Hold>& holds, double friction, const Eigen::Vector3d& mass);

  /// Returns whether there are forces that hold the body on level ground. There are such forces where it
  /// stays at rest; where it is wedged, whether it does depends on how it came there.
  bool balance() const;

  /// Returns the tangent of the smallest tilt of the ground, in the worst direction, at which no forces hold
  /// the body; where none do on level ground, minus that of the tilt that it takes. At most `max_tilt`;
  /// -infinity where no tilt helps. The tilts that forces hold are a convex region. Its border is found where
  /// it is nearest, by supporting lines (Bretl and Lall 2008), to tolerance::tilt of its distance and on the
  /// safe side.
  double tilt_margin() const;

  /// Returns the largest pull along `axis` through the centre of mass that the holds resist by friction, with
  /// normal forces that keep each other in balance sideways. Nothing where no such forces exist.
  std::optional<Grip> grip(const Eigen::Vector3d& axis) const;

  static constexpr double max_tilt = 1000;  ///< tangent

 private:
  std::optional<Eigen::Vector2d> farthest_tilt(const Eigen::Vector2d& towards) const;

  /// Per generator of a friction cone: the force with a normal force of 1, and its torque about the centre of
  /// mass, in distances of the farthest hold.
  Eigen::Matrix<double, 6, Eigen::Dynamic> wrenches_;
  std::vector<std::size_t> hold_of_;  ///< per generator
  std::vector<Hold> holds_;
  double friction_;
};

}  // namespace stackabilization::detail
