#pragma once

#include <Eigen/Core>

namespace stackabilization {

/// A stacking direction r: three finite doubles, not all zero, taken exactly as given. It needs no unit
/// length: (0.3, -0.2, 1) means those three doubles, and exact results are expressed in units of this very
/// vector.
class Direction {
 public:
  /// Throws UsageError when a component is not finite, all are zero, or the squared length overflows or
  /// underflows.
  explicit Direction(const Eigen::Vector3d& vector);
  /// The same by components.
  Direction(double x, double y, double z) : Direction(Eigen::Vector3d(x, y, z)) {}

  const Eigen::Vector3d& vector() const { return vector_; }  ///< r, as given
  double length() const;                                     ///< |r|: model units per unit of r
  Eigen::Vector3d unit() const;                              ///< r / |r|, rounded

 private:
  Eigen::Vector3d vector_;
};

/// Orthonormal right-handed frame whose third axis is along a direction.
struct Frame {
  Eigen::Vector3d u, v, w;  ///< w = r / |r|, u x v = w.

  /// Coordinates of p in this frame: (u.p, v.p, w.p).
  Eigen::Vector3d to_local(const Eigen::Vector3d& p) const { return {u.dot(p), v.dot(p), w.dot(p)}; }
  /// The point with coordinates q in this frame: the inverse of `to_local`.
  Eigen::Vector3d to_world(const Eigen::Vector3d& q) const { return u * q.x() + v * q.y() + w * q.z(); }
};

/// The frame that the minimal rotation taking +z to r gives to the axes x, y, z. For r along -z it is the
/// half turn about x. It varies continuously with r except there.
Frame frame_of(const Direction& direction);

}  // namespace stackabilization
