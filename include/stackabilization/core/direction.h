#pragma once

#include <Eigen/Core>

namespace stackabilization {

/// A stacking direction r: three finite doubles, not all zero, used exactly as given. It need not have unit
/// length: (0.3, -0.2, 1) means exactly these doubles. Exact results are in units of this vector.
class Direction {
 public:
  /// Throws UsageError when a component is not finite, all are zero, or the squared length overflows or
  /// underflows.
  explicit Direction(const Eigen::Vector3d& vector);
  /// Creates a direction from its components. Throws as above.
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

  /// Returns the coordinates of p in this frame: (u.p, v.p, w.p).
  Eigen::Vector3d to_local(const Eigen::Vector3d& p) const { return {u.dot(p), v.dot(p), w.dot(p)}; }
  /// Returns the point with coordinates q in this frame: the inverse of `to_local`.
  Eigen::Vector3d to_world(const Eigen::Vector3d& q) const { return u * q.x() + v * q.y() + w * q.z(); }
};

/// Returns the frame of a direction: the axes x, y, z after the minimal rotation from +z to r. For r along -z
/// it is the half turn about x. The frame is continuous in r except there.
Frame frame_of(const Direction& direction);

}  // namespace stackabilization
