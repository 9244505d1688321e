#include "structure/segmentation/hierarchical_fitting.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <tuple>

#include "core/disjoint_sets.h"
#include "structure/segmentation/chords.h"
#include "structure/segmentation/segment_boundaries.h"
#include "structure/segmentation/surface_patches.h"
#include "structure/segmentation/volume_fit.h"

namespace stackabilization::detail {

namespace {

/// Smallest and largest number of patches, triangles per patch, and chords per patch.
constexpr int min_patches = 24, max_patches = 240, triangles_per_patch = 4, chords_per_patch = 10;

int patch_count(const SurfaceGraph& graph) {
  return std::clamp(graph.size() / triangles_per_patch, min_patches, max_patches);
}

/// Largest increase of the empty length by one union, root mean square over the whole surface, fraction of
/// the bounding-box diagonal.
constexpr double tolerated_emptiness = 0.016;

/// Additional cost of a union across concave edges of 90 degrees and more: as if the smaller piece were at
/// this distance, fraction of the bounding-box diagonal.
constexpr double concave_step = 0.1;

/// Visibility above which concave edges count fully (second value), and below which they do not count (first
/// value): deep inside a vessel, floor and wall belong together.
constexpr double deep_inside = 0.2, at_the_surface = 0.4;

/// Weight of the increase of the spread, relative to the empty length. It decides between unions that fit
/// equally well.
constexpr double compactness_of_parts = 0.0001;

/// Stretch of the boundary between two patches.
struct Border {
  double length = 0, concave = 0;  ///< the second one weighted by how concave the edges are

  Border& operator+=(const Border& other) {
    length += other.length;
    concave += other.concave;
    return *this;
  }
};

/// Patches with the data for measuring their unions.
class Patches {
 public:
  Patches(const Shape& shape, const SurfaceGraph& graph, const WholeSize& whole)
      : whole_(whole),
        patch_(surface_patches(shape, graph, patch_count(graph))),
        chords_(chords(shape, graph, patch_, chords_per_patch * patch_count(graph))) {
    const auto count = static_cast<std::size_t>(*std::max_element(patch_.begin(), patch_.end())) + 1;
    chords_of_.resize(count);
    borders_.resize(count);
    areas_.assign(count, 0);
    moments_.assign(count, Eigen::Vector3d::Zero());
    std::vector<double> chord_area(count, 0), free_area(count, 0);
    for (std::size_t c = 0; c < chords_.size(); ++c) {
      const std::size_t patch = patch_of(chords_[c].triangle);
      chords_of_[patch].push_back(static_cast<std::int32_t>(c));
      chord_area[patch] += chords_[c].area;
      free_area[patch] += chords_[c].area * chords_[c].ambient_visibility;
    }
    for (std::size_t p = 0; p < count; ++p)
      free_.push_back(chord_area[p] > 0 ? free_area[p] / chord_area[p] : 1);
    for (std::int32_t t = 0; t < graph.size(); ++t) {
      areas_[patch_of(t)] += graph.areas(t);
      moments_[patch_of(t)] += graph.areas(t) * graph.centres.row(t).transpose();
    }
    for (const SurfaceLink& link : graph.links) add_border(link);
  }

  std::int32_t count() const { return static_cast<std::int32_t>(areas_.size()); }
  const std::vector<std::int32_t>& of_triangles() const { return patch_; }
  const std::vector<std::int32_t>& chords_of(std::int32_t p) const {
    return chords_of_[static_cast<std::size_t>(p)];
  }
  const std::map<std::int32_t, Border>& borders(std::int32_t p) const {
    return borders_[static_cast<std::size_t>(p)];
  }
  double area(std::int32_t p) const { return areas_[static_cast<std::size_t>(p)]; }
  const Eigen::Vector3d& moment(std::int32_t p) const { return moments_[static_cast<std::size_t>(p)]; }
  double total_area() const { return whole_.area; }
  double diagonal() const { return whole_.diagonal; }

  /// Mean squared empty length that the volume of some chords contributes to the whole, fraction of the
  /// squared diagonal.
  double emptiness(const std::vector<std::int32_t>& chord) const {
    return volume_error(chords_, chord) / (total_area() * diagonal() * diagonal());
  }

 private:
  std::size_t patch_of(std::int32_t t) const {
    return static_cast<std::size_t>(patch_[static_cast<std::size_t>(t)]);
  }
  void add_border(const SurfaceLink& link) {
    const std::size_t a = patch_of(link.a), b = patch_of(link.b);
    if (a == b) return;
    const double free = (std::min(free_[a], free_[b]) - deep_inside) / (at_the_surface - deep_inside);
    const double concave = concavity(link) * std::clamp(free, 0.0, 1.0);
    borders_[a][static_cast<std::int32_t>(b)] += {link.length, link.length * concave};
    borders_[b][static_cast<std::int32_t>(a)] += {link.length, link.length * concave};
  }

  WholeSize whole_;
  std::vector<std::int32_t> patch_;
  std::vector<Chord> chords_;
  std::vector<std::vector<std::int32_t>> chords_of_;
  std::vector<std::map<std::int32_t, Border>> borders_;
  std::vector<double> areas_, free_;
  std::vector<Eigen::Vector3d> moments_;
};

/// Joins clusters of patches, cheapest pair first.
class VolumeClustering {
 public:
  VolumeClustering(const Patches& patches, double smallest)
      : patches_(patches),
        clusters_(static_cast<std::size_t>(patches.count())),
        min_area_(smallest * patches.total_area()) {
    for (std::int32_t p = 0; p < patches.count(); ++p) {
      at(p) = {patches.chords_of(p), patches.borders(p), patches.area(p),
               patches.emptiness(patches.chords_of(p)), patches.moment(p)};
      grown_ += is_grown(at(p));
    }
  }

  /// Joins clusters while the cheapest union costs at most `limit` and more than `least` clusters are not
  /// small segments.
  std::vector<std::int32_t> run(double limit, int least) {
    for (std::int32_t a = 0; a < patches_.count(); ++a)
      for (const auto& [b, border] : at(a).borders)
        if (b > a) push(a, b);
    DisjointSets sets(clusters_.size());
    while (!queue_.empty()) {
      const Union next = queue_.top();
      queue_.pop();
      if (next.stamp_a != at(next.a).stamp || next.stamp_b != at(next.b).stamp) continue;
      const bool small = !is_grown(at(next.a)) || !is_grown(at(next.b));
      if (!small && (next.cost > limit || grown_ <= least)) continue;
      merge(next.a, next.b);
      sets.join(static_cast<std::size_t>(next.a), static_cast<std::size_t>(next.b));
    }
    std::vector<std::int32_t> cluster(clusters_.size());
    for (std::size_t p = 0; p < cluster.size(); ++p) cluster[p] = static_cast<std::int32_t>(sets.root(p));
    return cluster;
  }

 private:
  struct Cluster {
    std::vector<std::int32_t> chords;
    std::map<std::int32_t, Border> borders;
    double area = 0, emptiness = 0;
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
  bool is_grown(const Cluster& cluster) const { return cluster.area > 0 && cluster.area >= min_area_; }
  void push(std::int32_t first, std::int32_t second);
  void merge(std::int32_t a, std::int32_t b);

  const Patches& patches_;
  std::vector<Cluster> clusters_;
  std::priority_queue<Union> queue_;
  double min_area_;
  int grown_ = 0;
};

void VolumeClustering::push(std::int32_t first, std::int32_t second) {
  const std::int32_t a = std::min(first, second), b = std::max(first, second);
  const Cluster &one = at(a), &two = at(b);
  double cost = 0;
  if (one.area > 0 && two.area > 0) {
    std::vector<std::int32_t> both = one.chords;
    both.insert(both.end(), two.chords.begin(), two.chords.end());
    const Border& border = one.borders.at(b);
    const double step = border.length > 0 ? concave_step * border.concave / border.length : 0;
    const double spread = one.area * two.area / (one.area + two.area) *
                          (one.moment / one.area - two.moment / two.area).squaredNorm() /
                          (patches_.total_area() * patches_.diagonal() * patches_.diagonal());
    cost = std::max(0.0, patches_.emptiness(both) - one.emptiness - two.emptiness) +
           compactness_of_parts * spread + step * step * std::min(one.area, two.area) / patches_.total_area();
  }
  queue_.push({cost, a, b, one.stamp, two.stamp});
}

void VolumeClustering::merge(std::int32_t a, std::int32_t b) {
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
    at(c).borders[a] += border;
    into.borders[c] += border;
  }
  from.borders.clear();
  into.emptiness = patches_.emptiness(into.chords);
  ++into.stamp;
  from.stamp = -1;
  for (const auto& [c, border] : into.borders) push(a, c);
}

}  // namespace

std::vector<std::int32_t> fitted_parts(const Shape& shape, const SurfaceGraph& graph, int parts,
                                       double smallest, const WholeSize& whole) {
  const Patches patches(shape, graph, whole);
  const double limit =
      parts > 0 ? std::numeric_limits<double>::infinity() : tolerated_emptiness * tolerated_emptiness;
  const std::vector<std::int32_t> cluster =
      VolumeClustering(patches, smallest).run(limit, std::max(1, parts));
  std::vector<std::int32_t> part;
  for (const std::int32_t p : patches.of_triangles()) part.push_back(cluster[static_cast<std::size_t>(p)]);
  return part;
}

}  // namespace stackabilization::detail
