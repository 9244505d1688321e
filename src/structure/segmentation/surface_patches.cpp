#include "structure/segmentation/surface_patches.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <queue>
#include <set>
#include <tuple>

#include "core/disjoint_sets.h"
#include "mesh/moments.h"

namespace stackabilization::detail {

namespace {

/// Weight of the spread of a union, relative to its fitting error: it decides between unions that fit
/// exactly.
constexpr double compactness_of_patches = 0.001;

class PatchClustering {
 public:
  PatchClustering(const Shape& shape, const SurfaceGraph& graph)
      : clusters_(static_cast<std::size_t>(graph.size())), sets_(clusters_.size()) {
    Eigen::AlignedBox3d box;
    for (std::int32_t t = 0; t < graph.size(); ++t)
      for (int k = 0; k < 3; ++k) box.extend(shape.corner(t, k));
    const double scale = box.diagonal().norm() > 0 ? 1 / box.diagonal().norm() : 1;
    for (std::int32_t t = 0; t < graph.size(); ++t) {
      std::array<Eigen::Vector3d, 3> corners;
      for (int k = 0; k < 3; ++k)
        corners[static_cast<std::size_t>(k)] = (shape.corner(t, k) - box.center()) * scale;
      clusters_[static_cast<std::size_t>(t)].moments =
          triangle_moments(corners, graph.normals.row(t).transpose());
    }
    for (const SurfaceLink& link : graph.links) {
      clusters_[static_cast<std::size_t>(link.a)].neighbours.insert(link.b);
      clusters_[static_cast<std::size_t>(link.b)].neighbours.insert(link.a);
    }
  }

  std::vector<std::int32_t> run(int count) {
    for (std::int32_t a = 0; a < static_cast<std::int32_t>(clusters_.size()); ++a)
      for (const std::int32_t b : at(a).neighbours)
        if (b > a) push(a, b);
    for (auto left = static_cast<int>(clusters_.size()); left > count && !queue_.empty();) {
      const Contraction next = queue_.top();
      queue_.pop();
      if (next.stamp_a != at(next.a).stamp || next.stamp_b != at(next.b).stamp) continue;
      contract(next.a, next.b);
      --left;
    }
    return numbers();
  }

 private:
  struct Cluster {
    Moments moments;
    std::set<std::int32_t> neighbours;  ///< ordered, for one sequence everywhere
    std::int32_t stamp = 0;             ///< counts the changes; -1 once merged into another
  };
  struct Contraction {
    double cost;
    std::int32_t a, b, stamp_a, stamp_b;
    bool operator<(const Contraction& other) const {  // cheapest on top
      return std::tie(cost, a, b) > std::tie(other.cost, other.a, other.b);
    }
  };

  Cluster& at(std::int32_t c) { return clusters_[static_cast<std::size_t>(c)]; }

  static double cost(const Moments& m) {
    if (!(m.area() > 0)) return 0;
    const double spread = m.second().trace() - m.first().squaredNorm() / m.area();
    return std::min({plane_error(m), sphere_error(m), cylinder_error(m)}) + compactness_of_patches * spread;
  }

  void push(std::int32_t a, std::int32_t b) {
    Moments both = at(a).moments;
    both += at(b).moments;
    queue_.push({cost(both), a, b, at(a).stamp, at(b).stamp});
  }

  void contract(std::int32_t a, std::int32_t b) {
    at(a).moments += at(b).moments;
    ++at(a).stamp;
    at(b).stamp = -1;
    sets_.join(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
    for (const std::int32_t c : at(b).neighbours) {
      at(c).neighbours.erase(b);
      if (c == a) continue;
      at(c).neighbours.insert(a);
      at(a).neighbours.insert(c);
    }
    at(b).neighbours.clear();
    for (const std::int32_t c : at(a).neighbours) push(std::min(a, c), std::max(a, c));
  }

  std::vector<std::int32_t> numbers() {
    std::vector<std::int32_t> number(clusters_.size());
    std::int32_t next = 0;
    for (std::size_t t = 0; t < clusters_.size(); ++t) {
      const std::size_t root = sets_.root(t);
      number[t] = root == t ? next++ : number[root];
    }
    return number;
  }

  std::vector<Cluster> clusters_;
  DisjointSets sets_;
  std::priority_queue<Contraction> queue_;
};

}  // namespace

std::vector<std::int32_t> surface_patches(const Shape& shape, const SurfaceGraph& graph, int count) {
  return PatchClustering(shape, graph).run(count);
}

}  // namespace stackabilization::detail
