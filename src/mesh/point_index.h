#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace stackabilization {

/// Numbers different points 0, 1, 2, ... in the order of insertion. Points are equal when their coordinates
/// are equal (-0 = 0). Expected O(1) per point.
class PointIndex {
 public:
  /// Returns the number of `point`, and adds the point when it is new. Precondition: finite coordinates.
  std::int32_t insert(const Eigen::Vector3d& point);
  /// Returns the different points by their numbers.
  const std::vector<Eigen::Vector3d>& points() const { return points_; }

 private:
  void grow();
  std::size_t slot_of(const Eigen::Vector3d& point) const;

  std::vector<Eigen::Vector3d> points_;
  /// Hash table with open addressing; the size is a power of two, -1 is free.
  std::vector<std::int32_t> slots_;
};

}  // namespace stackabilization
