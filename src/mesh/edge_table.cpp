#include "mesh/edge_table.h"

#include <algorithm>
#include <tuple>

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
  std::sort(sides_.begin(), sides_.end(), [](const TriangleSide& a, const TriangleSide& b) {
    return std::tie(a.low, a.high, a.triangle, a.corner) < std::tie(b.low, b.high, b.triangle, b.corner);
  });
  for (std::size_t s = 0; s < sides_.size(); ++s)
    if (s == 0 || sides_[s].low != sides_[s - 1].low || sides_[s].high != sides_[s - 1].high)
      first_.push_back(s);
  first_.push_back(sides_.size());
}

}  // namespace stackabilization::detail
