#include "mesh/gauss_arcs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

#include "core/angles.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {

std::vector<GaussArc> gauss_arcs(const HullSupport& hull,
                                 const std::function<bool(const Eigen::Vector3d&)>& wanted) {
  const Eigen::Vector3d one_side(1, 1.0 / 2, 1.0 / 4);
  std::vector<GaussArc> arcs;
  for (Eigen::Index e = 0; e < hull.edge_faces().rows(); ++e) {
    const int from = hull.edge_faces()(e, 0), to = hull.edge_faces()(e, 1);
    Eigen::Vector3d start = hull.face_normals().row(from).transpose();
    Eigen::Vector3d end = hull.face_normals().row(to).transpose();
    if (start.isZero() || end.isZero() || !wanted(start) || !wanted(end)) continue;
    if ((start + end).dot(one_side) < 0) {
      start = -start;
      end = -end;
    }
    const Eigen::Vector3d side = (end - start * start.dot(end)).stableNormalized();
    arcs.push_back({from, to, start, side, angle_between(start, end)});
  }
  return arcs;
}

std::vector<GaussArc> without_needless_arcs(std::vector<GaussArc> arcs, const Eigen::Matrix3d& axes) {
  const auto near = [&](const GaussArc& arc, int axis) {
    const auto within = [&](double angle) {
      return std::abs(arc.normal(angle).dot(axes.col(axis))) > std::numbers::sqrt2 / 2 + tolerance::rounding;
    };
    return within(0) && within(arc.length) && within(arc.length / 2);
  };
  std::array<std::ptrdiff_t, 3> counts{};
  for (int axis = 0; axis < 3; ++axis)
    counts[static_cast<std::size_t>(axis)] =
        std::count_if(arcs.begin(), arcs.end(), [&](const GaussArc& arc) { return near(arc, axis); });
  const int most = static_cast<int>(std::max_element(counts.begin(), counts.end()) - counts.begin());
  std::erase_if(arcs, [&](const GaussArc& arc) { return near(arc, most); });
  return arcs;
}

GaussArcTree::GaussArcTree(const std::vector<GaussArc>& arcs) {
  for (const GaussArc& arc : arcs)
    entries_.push_back(
        {static_cast<int>(entries_.size()), arc.start, arc.normal(arc.length / 2), arc.normal(arc.length)});
  nodes_.reserve(2 * arcs.size());
  if (!arcs.empty()) build(0, arcs.size());
}

int GaussArcTree::build(std::size_t first, std::size_t last) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  Node node;
  Eigen::Vector3d low = entries_[first].middle, high = low;
  for (std::size_t k = first; k < last; ++k) {
    low = low.cwiseMin(entries_[k].middle);
    high = high.cwiseMax(entries_[k].middle);
  }
  node.centre = last - first == 1 ? low : Eigen::Vector3d(((low + high) / 2).stableNormalized());
  double square = 0;  // of the longest chord from the centre
  for (std::size_t k = first; k < last; ++k)
    for (const Eigen::Vector3d& end : {entries_[k].start, entries_[k].end})
      square = std::max(square, (end - node.centre).squaredNorm());
  node.radius = 2 * std::asin(std::min(1.0, std::sqrt(square) / 2)) + tolerance::rounding;
  if (last - first == 1) {
    node.arc = entries_[first].arc;
  } else {
    Eigen::Index axis = 0;
    (high - low).maxCoeff(&axis);
    const auto before = [&](const Entry& a, const Entry& b) {
      return std::make_pair(a.middle[axis], a.arc) < std::make_pair(b.middle[axis], b.arc);
    };
    const std::size_t half = (first + last) / 2;
    const auto at = [&](std::size_t k) { return entries_.begin() + static_cast<std::ptrdiff_t>(k); };
    std::nth_element(at(first), at(half), at(last), before);
    node.left = build(first, half);
    node.right = build(half, last);
  }
  nodes_[static_cast<std::size_t>(index)] = node;
  return index;
}

}  // namespace stackabilization::detail
