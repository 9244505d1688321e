#include "stackabilization/structure/hierarchical_fitting.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <queue>
#include <tuple>

#include "stackabilization/shape/disjoint_sets.h"
#include "stackabilization/structure/chords.h"
#include "stackabilization/structure/surface_patches.h"
#include "stackabilization/structure/volume_fit.h"

namespace stackabilization::detail {

namespace {

/// Patches to build volumes from, and chords to measure them with.
constexpr int patch_count = 240, chord_count = 2400;

/// Emptiness that one union may add, root mean square over the whole surface, fraction of the bounding-box
/// diagonal.
constexpr double tolerated_emptiness = 0.018;

/// How many times more a union costs across an edge of 90 degrees, concave or more so, than across a flat
/// one.
constexpr double concave_factor = 6;

/// Weight of the growth of the spread, beside emptiness: decides between unions that fit equally well.
constexpr double compactness = 0.0001;

class VolumeClustering {
 public:
  VolumeClustering(const Shape& shape, const SurfaceGraph& graph)
      : graph_(graph),
        patch_(surface_patches(shape, graph, patch_count)),
        chords_(chords(shape, graph, patch_, chord_count)) {
    const auto count = static_cast<std::size_t>(*std::max_element(patch_.begin(), patch_.end())) + 1;
    clusters_.resize(count);
    for (std::size_t c = 0; c < chords_.size(); ++c)
      at(patch_[static_cast<std::size_t>(chords_[c].triangle)])
          .chords.push_back(static_cast<std::int32_t>(c));
    Eigen::AlignedBox3d box;
    for (std::int32_t t = 0; t < graph.size(); ++t) {
      Cluster& cluster = at(patch_[static_cast<std::size_t>(t)]);
      cluster.area += graph.areas(t);
      cluster.moment += graph.areas(t) * graph.centres.row(t).transpose();
      for (int k = 0; k < 3; ++k) box.extend(shape.corner(t, k));
    }
    scale_ = graph.areas.sum() * box.diagonal().squaredNorm();
    for (const SurfaceLink& link : graph.links) add_border(link);
    for (Cluster& cluster : clusters_) cluster.error = volume_error(chords_, cluster.chords);
  }

  std::vector<std::int32_t> run(int parts, double smallest) {
    smallest_area_ = smallest * graph_.areas.sum();
    for (const Cluster& cluster : clusters_) grown_ += is_grown(cluster);
    for (std::int32_t a = 0; a < static_cast<std::int32_t>(clusters_.size()); ++a)
      for (const auto& [b, border] : at(a).borders)
        if (b > a) push(a, b);
    DisjointSets sets(clusters_.size());
    const double limit = tolerated_emptiness * tolerated_emptiness;
    while (!queue_.empty()) {
      const Union next = queue_.top();
      queue_.pop();
      if (next.stamp_a != at(next.a).stamp || next.stamp_b != at(next.b).stamp) continue;
      const bool crumb = !is_grown(at(next.a)) || !is_grown(at(next.b));
      if (!crumb && (parts > 0 ? grown_ <= parts : next.cost > limit)) continue;
      merge(next.a, next.b);
      sets.join(static_cast<std::size_t>(next.a), static_cast<std::size_t>(next.b));
    }
    std::vector<std::int32_t> part(patch_.size());
    for (std::size_t t = 0; t < part.size(); ++t)
      part[t] = static_cast<std::int32_t>(sets.root(static_cast<std::size_t>(patch_[t])));
    return part;
  }

 private:
  struct Border {
    double length = 0, weighted = 0;  ///< the second one with the factors of concave edges
  };
  struct Cluster {
    std::vector<std::int32_t> chords;
    std::map<std::int32_t, Border> borders;
    double area = 0, error = 0;
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< integral of the position
    std::int32_t stamp = 0;                            ///< counts the changes; -1 once merged into another
  };
  struct Union {
    double cost;
    std::int32_t a, b, stamp_a, stamp_b;
    bool operator<(const Union& other) const {  // cheapest on top
      return std::tie(cost, a, b) > std::tie(other.cost, other.a, other.b);
    }
  };

  Cluster& at(std::int32_t c) { return clusters_[static_cast<std::size_t>(c)]; }
  bool is_grown(const Cluster& cluster) const { return cluster.area > 0 && cluster.area >= smallest_area_; }

  void add_border(const SurfaceLink& link) {
    const std::int32_t a = patch_[static_cast<std::size_t>(link.a)],
                       b = patch_[static_cast<std::size_t>(link.b)];
    if (a == b) return;
    const double concave = std::clamp(-link.bend / (std::numbers::pi / 2), 0.0, 1.0);
    const double factor = 1 + (concave_factor - 1) * concave;
    for (Border* border : {&at(a).borders[b], &at(b).borders[a]}) {
      border->length += link.length;
      border->weighted += link.length * factor;
    }
  }

  void push(std::int32_t first, std::int32_t second) {
    const std::int32_t a = std::min(first, second), b = std::max(first, second);
    const Cluster &one = at(a), &two = at(b);
    double cost = 0;
    if (one.area > 0 && two.area > 0 && scale_ > 0) {
      std::vector<std::int32_t> both = one.chords;
      both.insert(both.end(), two.chords.begin(), two.chords.end());
      const Border& border = one.borders.at(b);
      const double factor = border.length > 0 ? border.weighted / border.length : 1;
      const double emptiness = std::max(0.0, volume_error(chords_, both) - one.error - two.error);
      const double spread = one.area * two.area / (one.area + two.area) *
                            (one.moment / one.area - two.moment / two.area).squaredNorm();
      cost = factor * (emptiness + compactness * spread) / scale_;
    }
    queue_.push({cost, a, b, one.stamp, two.stamp});
  }

  void merge(std::int32_t a, std::int32_t b) {
    Cluster &into = at(a), &from = at(b);
    grown_ -= is_grown(into) + is_grown(from);
    into.chords.insert(into.chords.end(), from.chords.begin(), from.chords.end());
    std::sort(into.chords.begin(), into.chords.end());
    into.area += from.area;
    into.moment += from.moment;
    grown_ += is_grown(into);
    for (const auto& [c, border] : from.borders) {
      at(c).borders.erase(b);
      if (c == a) continue;
      for (Border* sum : {&at(c).borders[a], &into.borders[c]}) {
        sum->length += border.length;
        sum->weighted += border.weighted;
      }
    }
    from.borders.clear();
    into.error = volume_error(chords_, into.chords);
    ++into.stamp;
    from.stamp = -1;
    for (const auto& [c, border] : into.borders) push(a, c);
  }

  const SurfaceGraph& graph_;
  std::vector<std::int32_t> patch_;
  std::vector<Chord> chords_;
  std::vector<Cluster> clusters_;
  std::priority_queue<Union> queue_;
  double scale_ = 0, smallest_area_ = 0;
  int grown_ = 0;
};

}  // namespace

std::vector<std::int32_t> fitted_parts(const Shape& shape, const SurfaceGraph& graph, int parts,
                                       double smallest) {
  return VolumeClustering(shape, graph).run(parts, smallest);
}

}  // namespace stackabilization::detail
