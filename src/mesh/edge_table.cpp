#include "mesh/edge_table.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <utility>

namespace stackabilization::detail {

EdgeTable::EdgeTable(const Eigen::Ref<const Triangles>& triangles, Collapsed collapsed) {
  sides_.reserve(static_cast<std::size_t>(3 * triangles.rows()));
  for (std::int32_t t = 0; t < triangles.rows(); ++t) {
    const auto corner = triangles.row(t);
    const bool repeats = corner(0) == corner(1) || corner(1) == corner(2) || corner(2) == corner(0);
    if (repeats && collapsed == Collapsed::skip) continue;
    for (std::int32_t k = 0; k < 3; ++k) {
      const std::int32_t from = corner(k), to = corner((k + 1) % 3);
      if (from != to) sides_.push_back({std::min(from, to), std::max(from, to), t, k, from < to});
    }
  }
  sort_sides(triangles.rows() > 0 ? triangles.maxCoeff() + 1 : 0);
  for (std::size_t s = 0; s < sides_.size(); ++s)
    if (s == 0 || sides_[s].low != sides_[s - 1].low || sides_[s].high != sides_[s - 1].high)
      first_.push_back(s);
  first_.push_back(sides_.size());
}

/// The sides are in the order of triangles and corners. Those of each lower vertex are brought together in
/// this order, then the few of each vertex are sorted by the other one.
void EdgeTable::sort_sides(std::int32_t vertices) {
  std::vector<std::size_t> next(static_cast<std::size_t>(vertices) + 1, 0);
  for (const TriangleSide& side : sides_) ++next[static_cast<std::size_t>(side.low) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<TriangleSide> sorted(sides_.size());
  for (const TriangleSide& side : sides_) sorted[next[static_cast<std::size_t>(side.low)]++] = side;
  // next[v] is now where the sides of v end.
  auto begin = sorted.begin();
  for (std::int32_t vertex = 0; vertex < vertices; ++vertex) {
    const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(next[static_cast<std::size_t>(vertex)]);
    std::sort(begin, end, [](const TriangleSide& a, const TriangleSide& b) {
      return std::tie(a.high, a.triangle, a.corner) < std::tie(b.high, b.triangle, b.corner);
    });
    begin = end;
  }
  sides_ = std::move(sorted);
}

}  // namespace stackabilization::detail
