#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace stackabilization {

/// Numbers the different points it is shown 0, 1, 2 ... in order of first appearance. Points are equal when
/// their coordinates are (-0 = 0); expected O(1) per point.
class PointIndex {
 public:
  /// Number of `point`, new or not. Precondition: finite coordinates.
  std::int32_t insert(const Eigen::Vector3d& point);
  /// The different points, by their numbers.
  const std::vector<Eigen::Vector3d>& points() const { return points_; }

 private:
  void grow();
  std::size_t slot_of(const Eigen::Vector3d& point) const;

  std::vector<Eigen::Vector3d> points_;
  std::vector<std::int32_t> slots_;  ///< Open addressing, a power of two long; -1 is free.
};

}  // namespace stackabilization
