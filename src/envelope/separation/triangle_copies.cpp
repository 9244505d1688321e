#include "envelope/separation/triangle_copies.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace stackabilization::detail {
namespace {

using Corners = std::array<std::array<double, 3>, 3>;

/// Of a hash table with open addressing: a triangle that stays, -1 where there is none.
struct Slot {
  std::int32_t row = -1;
  std::uint32_t tag = 0;  ///< low bits of its hash
};

/// Mixes the bits of the coordinates (finalizer of MurmurHash3, Appleby 2011).
std::uint64_t hash(const std::array<double, 3>& point) {
  std::uint64_t state = 0;
  for (const double coordinate : point) {
    state = (state ^ std::bit_cast<std::uint64_t>(coordinate + 0.0)) * 0xff51afd7ed558ccd;
    state ^= state >> 33;
  }
  return state;
}

/// The same for corners in any order.
std::uint64_t hash(const Corners& corners) {
  return (hash(corners[0]) + hash(corners[1]) + hash(corners[2])) * 0xc4ceb9fe1a85ec53;
}

bool same_points(Corners a, Corners b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}

}  // namespace

std::vector<TriangleCopy> take_copies(std::vector<TreeTriangle>& triangles) {
  const std::uint64_t size = std::bit_ceil(2 * static_cast<std::uint64_t>(triangles.size()));
  const int shift = 64 - std::bit_width(size - 1);
  std::vector<Slot> slots(size);
  std::vector<TriangleCopy> copies;
  std::int32_t kept = 0;
  for (const TreeTriangle& triangle : triangles) {
    const std::uint64_t mixed = hash(triangle.corners);
    const auto tag = static_cast<std::uint32_t>(mixed);
    std::uint64_t at = mixed >> shift;
    while (slots[at].row >= 0 &&
           (slots[at].tag != tag || !same_points(triangles[slots[at].row].corners, triangle.corners)))
      at = (at + 1) & (size - 1);
    if (slots[at].row >= 0) {
      copies.push_back({triangles[slots[at].row].index, triangle.index});
      continue;
    }
    slots[at] = {kept, tag};
    triangles[kept++] = triangle;
  }
  triangles.resize(kept);
  std::sort(copies.begin(), copies.end());
  return copies;
}

}  // namespace stackabilization::detail
