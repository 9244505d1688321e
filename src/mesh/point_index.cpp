#include "mesh/point_index.h"

#include <algorithm>
#include <bit>

namespace stackabilization {

namespace {

constexpr std::int32_t free_slot = -1;

/// Bits of the coordinates, mixed by the finalizer of SplitMix64 (Steele, Lea, Flood 2014).
std::uint64_t hash(const Eigen::Vector3d& point) {
  std::uint64_t state = 0;
  for (int axis = 0; axis < 3; ++axis) {
    state += std::bit_cast<std::uint64_t>(point[axis]) + 0x9e3779b97f4a7c15;
    state = (state ^ (state >> 30)) * 0xbf58476d1ce4e5b9;
    state = (state ^ (state >> 27)) * 0x94d049bb133111eb;
    state ^= state >> 31;
  }
  return state;
}

}  // namespace

std::size_t PointIndex::slot_of(const Eigen::Vector3d& point) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash(point) & mask;
  while (slots_[slot] != free_slot && points_[static_cast<std::size_t>(slots_[slot])] != point)
    slot = (slot + 1) & mask;
  return slot;
}

void PointIndex::grow() {
  constexpr std::size_t first_size = 64;
  slots_.assign(std::max(first_size, 2 * slots_.size()), free_slot);
  for (std::size_t i = 0; i < points_.size(); ++i) slots_[slot_of(points_[i])] = static_cast<std::int32_t>(i);
}

std::int32_t PointIndex::insert(const Eigen::Vector3d& point) {
  if (2 * points_.size() >= slots_.size()) grow();
  const Eigen::Vector3d positive_zeros = point.array() + 0.0;
  const std::size_t slot = slot_of(positive_zeros);
  if (slots_[slot] == free_slot) {
    slots_[slot] = static_cast<std::int32_t>(points_.size());
    points_.push_back(positive_zeros);
  }
  return slots_[slot];
}

}  // namespace stackabilization
