#include <algorithm>
#include <cstddef>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

#include "structure/fitting/curve_skeleton.h"

namespace stackabilization::detail {

namespace {

/// Shares of the length of a skeleton that its loop, or its longest path, must have at least. A branching
/// skeleton is not a tube.
constexpr double loop_share = 0.5;
constexpr double path_share = 0.85;

class SkeletonGraph {
 public:
  explicit SkeletonGraph(const Skeleton& skeleton) : skeleton_(skeleton) {
    neighbours_.resize(static_cast<std::size_t>(skeleton.points.rows()));
    for (const auto& [a, b] : skeleton.edges) {
      neighbours_[static_cast<std::size_t>(a)].push_back(b);
      neighbours_[static_cast<std::size_t>(b)].push_back(a);
    }
  }

  /// Returns the loop that remains after removal of all branches, in order; empty unless there is exactly
  /// one.
  std::vector<int> loop() const {
    std::vector<int> degree;
    for (const auto& list : neighbours_) degree.push_back(static_cast<int>(list.size()));
    std::vector<int> leaves;
    for (int v = 0; v < static_cast<int>(degree.size()); ++v)
      if (degree[at(v)] == 1) leaves.push_back(v);
    while (!leaves.empty()) {
      const int leaf = leaves.back();
      leaves.pop_back();
      degree[at(leaf)] = 0;
      for (const int next : neighbours_[at(leaf)])
        if (degree[at(next)] > 0 && --degree[at(next)] == 1) leaves.push_back(next);
    }
    const auto first = std::find_if(degree.begin(), degree.end(), [](int d) { return d > 0; });
    if (first == degree.end() || *std::max_element(degree.begin(), degree.end()) > 2) return {};
    std::vector<int> ring{static_cast<int>(first - degree.begin())};
    for (int before = -1;;) {
      const int here = ring.back();
      const auto& around = neighbours_[at(here)];
      const auto next =
          std::find_if(around.begin(), around.end(), [&](int v) { return degree[at(v)] > 0 && v != before; });
      if (next == around.end() || *next == ring.front()) break;
      before = here;
      ring.push_back(*next);
    }
    const auto left = std::count_if(degree.begin(), degree.end(), [](int d) { return d > 0; });
    return static_cast<std::ptrdiff_t>(ring.size()) == left && left >= 3 ? ring : std::vector<int>{};
  }

  /// The shortest path from `start` to the vertex farthest from it.
  std::vector<int> farthest_path(int start) const {
    std::vector<double> length(neighbours_.size(), std::numeric_limits<double>::infinity());
    std::vector<int> before(neighbours_.size(), -1);
    std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> open;
    length[at(start)] = 0;
    open.emplace(0.0, start);
    int last = start;
    while (!open.empty()) {
      const auto [distance, here] = open.top();
      open.pop();
      if (distance > length[at(here)]) continue;
      last = here;
      for (const int next : neighbours_[at(here)]) {
        const double reached = distance + edge_length(here, next);
        if (reached >= length[at(next)]) continue;
        length[at(next)] = reached;
        before[at(next)] = here;
        open.emplace(reached, next);
      }
    }
    std::vector<int> path;
    for (int v = last; v != -1; v = before[at(v)]) path.push_back(v);
    return path;
  }

  double edge_length(int a, int b) const {
    return (skeleton_.points.row(a) - skeleton_.points.row(b)).norm();
  }

  double length_of(const std::vector<int>& path) const {
    double sum = 0;
    for (std::size_t k = 1; k < path.size(); ++k) sum += edge_length(path[k - 1], path[k]);
    return sum;
  }

  double total_length() const {
    double sum = 0;
    for (const auto& [a, b] : skeleton_.edges) sum += edge_length(a, b);
    return sum;
  }

 private:
  static std::size_t at(int v) { return static_cast<std::size_t>(v); }

  const Skeleton& skeleton_;
  std::vector<std::vector<int>> neighbours_;
};

Curve curve_through(const Skeleton& skeleton, const std::vector<int>& rows, bool closed) {
  Curve curve{Points(static_cast<Eigen::Index>(rows.size()), 3), closed};
  for (std::size_t k = 0; k < rows.size(); ++k)
    curve.points.row(static_cast<Eigen::Index>(k)) = skeleton.points.row(rows[k]);
  return curve;
}

}  // namespace

std::optional<Curve> main_curve(const Skeleton& skeleton) {
  if (skeleton.edges.empty()) return std::nullopt;
  const SkeletonGraph graph(skeleton);
  const std::vector<int> ring = graph.loop();
  if (!ring.empty() && graph.length_of(ring) + graph.edge_length(ring.back(), ring.front()) >
                           loop_share * graph.total_length())
    return curve_through(skeleton, ring, true);

  std::vector<int> path = graph.farthest_path(graph.farthest_path(skeleton.edges.front()[0]).front());
  if (path.size() < 2 || graph.length_of(path) < path_share * graph.total_length()) return std::nullopt;
  const auto place = [&](int row) {
    const auto p = skeleton.points.row(row);
    return std::make_tuple(p.z(), p.y(), p.x());
  };
  if (place(path.back()) < place(path.front())) std::reverse(path.begin(), path.end());
  return curve_through(skeleton, path, false);
}

}  // namespace stackabilization::detail
