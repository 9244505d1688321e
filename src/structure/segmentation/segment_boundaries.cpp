#include "structure/segmentation/segment_boundaries.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <queue>
#include <set>
#include <utility>

#include "core/disjoint_sets.h"

namespace stackabilization::detail {

namespace {

constexpr double far_away = std::numeric_limits<double>::infinity();

/// Factor by which a cut along a concave edge of 90 degrees is cheaper than along a flat edge.
constexpr double cutting_factor = 10;

/// Width of the band around a boundary inside a part: at most this share of the depth of the part, ...
constexpr double band_share = 0.5;
/// ... and at most this share of the square root of the smaller part's area.
constexpr double band_width = 0.2;

using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::bidirectionalS>;
using FlowGraph = boost::adjacency_list<
    boost::vecS, boost::vecS, boost::bidirectionalS,
    boost::property<boost::vertex_index_t, long,
                    boost::property<boost::vertex_color_t, boost::default_color_type,
                                    boost::property<boost::vertex_distance_t, long,
                                                    boost::property<boost::vertex_predecessor_t,
                                                                    Traits::edge_descriptor>>>>,
    boost::property<boost::edge_capacity_t, double,
                    boost::property<boost::edge_residual_capacity_t, double,
                                    boost::property<boost::edge_reverse_t, Traits::edge_descriptor>>>>;

/// Minimum cut between two terminals.
class MinimumCut {
 public:
  explicit MinimumCut(std::size_t nodes) : graph_(nodes + 2), source_(nodes), sink_(nodes + 1) {}

  void tie(std::size_t a, std::size_t b, double capacity) {
    const auto forth = boost::add_edge(a, b, graph_).first, back = boost::add_edge(b, a, graph_).first;
    boost::put(boost::edge_capacity, graph_, forth, capacity);
    boost::put(boost::edge_capacity, graph_, back, capacity);
    boost::put(boost::edge_reverse, graph_, forth, back);
    boost::put(boost::edge_reverse, graph_, back, forth);
  }
  void tie_to_source(std::size_t node, double capacity) { tie(source_, node, capacity); }
  void tie_to_sink(std::size_t node, double capacity) { tie(node, sink_, capacity); }

  /// Per node whether it stays with the source.
  std::vector<char> run() {
    boost::boykov_kolmogorov_max_flow(graph_, source_, sink_);
    const auto source_colour = boost::get(boost::vertex_color, graph_, source_);
    std::vector<char> side(source_);
    for (std::size_t n = 0; n < side.size(); ++n)
      side[n] = boost::get(boost::vertex_color, graph_, n) == source_colour;
    return side;
  }

 private:
  FlowGraph graph_;
  std::size_t source_, sink_;
};

class BoundarySmoother {
 public:
  BoundarySmoother(const SurfaceGraph& graph, std::vector<std::int32_t> part, const std::vector<char>& fixed)
      : graph_(graph), part_(std::move(part)), fixed_(fixed) {
    for (const SurfaceLink& link : graph_.links) total_ += link.length;
  }

  std::vector<std::int32_t> run() {
    std::set<std::pair<std::int32_t, std::int32_t>> pairs;
    for (const SurfaceLink& link : graph_.links)
      if (const std::pair<std::int32_t, std::int32_t> p = std::minmax(part_at(link.a), part_at(link.b));
          p.first != p.second)
        pairs.insert(p);
    for (const auto& [a, b] : pairs) recut(a, b);
    return std::move(part_);
  }

 private:
  std::int32_t part_at(std::int32_t t) const { return part_[static_cast<std::size_t>(t)]; }
  bool is_fixed(std::int32_t t) const { return !fixed_.empty() && fixed_[static_cast<std::size_t>(t)]; }

  /// Distance along the surface within part `of` from its boundary with part `other`.
  std::vector<std::pair<std::int32_t, double>> depths(std::int32_t of, std::int32_t other) const;
  void recut(std::int32_t a, std::int32_t b);

  const SurfaceGraph& graph_;
  std::vector<std::int32_t> part_;
  const std::vector<char>& fixed_;
  double total_ = 1;  ///< more than any cut costs
};

std::vector<std::pair<std::int32_t, double>> BoundarySmoother::depths(std::int32_t of,
                                                                      std::int32_t other) const {
  std::map<std::int32_t, double> depth;
  using Entry = std::pair<double, std::int32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto reach = [&](std::int32_t t, double distance) {
    const auto [place, fresh] = depth.try_emplace(t, distance);
    if (!fresh && place->second <= distance) return;
    place->second = distance;
    queue.push({distance, t});
  };
  for (const SurfaceLink& link : graph_.links) {
    if (part_at(link.a) == of && part_at(link.b) == other) reach(link.a, 0);
    if (part_at(link.b) == of && part_at(link.a) == other) reach(link.b, 0);
  }
  while (!queue.empty()) {
    const auto [distance, t] = queue.top();
    queue.pop();
    if (distance > depth[t]) continue;
    for (const std::int32_t l : graph_.links_of[static_cast<std::size_t>(t)]) {
      const std::int32_t next = graph_.across(l, t);
      if (part_at(next) == of)
        reach(next, distance + (graph_.centres.row(next) - graph_.centres.row(t)).norm());
    }
  }
  return {depth.begin(), depth.end()};
}

void BoundarySmoother::recut(std::int32_t a, std::int32_t b) {
  struct Node {
    std::int32_t part;
    bool held;
  };
  const std::vector<std::pair<std::int32_t, double>> sides[2] = {depths(a, b), depths(b, a)};
  if (sides[0].empty() || sides[1].empty()) return;
  double smaller = far_away;
  for (const auto& side : sides) {
    double area = 0;
    for (const auto& [t, depth] : side) area += graph_.areas(t);
    smaller = std::min(smaller, area);
  }
  std::map<std::int32_t, std::size_t> node;
  std::vector<std::int32_t> triangles;
  std::vector<char> held;
  for (const auto& side : sides) {
    double deepest = 0;
    for (const auto& [t, depth] : side) deepest = std::max(deepest, depth);
    const double band = std::min(band_share * deepest, band_width * std::sqrt(smaller));
    for (const auto& [t, depth] : side) {
      node[t] = triangles.size();
      triangles.push_back(t);
      held.push_back(depth >= band || is_fixed(t));
    }
  }
  MinimumCut cut(triangles.size());
  for (std::size_t n = 0; n < triangles.size(); ++n) {
    if (held[n]) part_at(triangles[n]) == a ? cut.tie_to_source(n, total_) : cut.tie_to_sink(n, total_);
    for (const std::int32_t l : graph_.links_of[static_cast<std::size_t>(triangles[n])]) {
      const auto next = node.find(graph_.across(l, triangles[n]));
      if (next != node.end() && next->second > n)
        cut.tie(n, next->second, cutting_cost(graph_.links[static_cast<std::size_t>(l)]));
    }
  }
  const std::vector<char> with_a = cut.run();
  for (std::size_t n = 0; n < triangles.size(); ++n)
    part_[static_cast<std::size_t>(triangles[n])] = with_a[n] ? a : b;
}

/// Pieces are the connected sets of one part. The smallest triangle of a piece identifies it.
class SmallSegmentMerger {
 public:
  SmallSegmentMerger(const SurfaceGraph& graph, const std::vector<std::int32_t>& part, double min_area)
      : pieces_(part.size()), count_(part.size()), min_area_(min_area) {
    for (const SurfaceLink& link : graph.links)
      if (part[static_cast<std::size_t>(link.a)] == part[static_cast<std::size_t>(link.b)])
        pieces_.join(static_cast<std::size_t>(link.a), static_cast<std::size_t>(link.b));
    for (std::size_t t = 0; t < count_; ++t)
      area_[pieces_.root(t)] += graph.areas(static_cast<Eigen::Index>(t));
    for (const SurfaceLink& link : graph.links) {
      const std::size_t a = pieces_.root(static_cast<std::size_t>(link.a));
      const std::size_t b = pieces_.root(static_cast<std::size_t>(link.b));
      if (a == b) continue;
      ties_[a][b] += cutting_cost(link);
      ties_[b][a] += cutting_cost(link);
    }
    std::map<std::int32_t, std::size_t> largest;  // per part a piece
    for (const auto& [piece, size] : area_) {
      const auto [place, fresh] = largest.try_emplace(part[piece], piece);
      if (!fresh && size > area_[place->second]) place->second = piece;
    }
    for (const auto& [p, piece] : largest) main_.insert(piece);
    for (const auto& [piece, size] : area_)
      if (is_lesser(piece)) lesser_.insert({size, piece});
  }

  std::vector<std::int32_t> run() {
    while (!lesser_.empty()) {
      const std::size_t piece = lesser_.begin()->second;
      lesser_.erase(lesser_.begin());
      if (const std::size_t host = host_of(piece); host != piece) join(piece, host);
    }
    std::vector<std::int32_t> part(count_);
    std::int32_t next = 0;
    for (std::size_t t = 0; t < count_; ++t) {
      const std::size_t root = pieces_.root(t);
      part[t] = root == t ? next++ : part[root];
    }
    return part;
  }

 private:
  /// Returns the piece that a lesser one joins: the neighbour with the strongest link or, for one without
  /// neighbours and area, the largest of all; itself where there is none.
  std::size_t host_of(std::size_t piece) {
    const auto smaller = [](const auto& a, const auto& b) { return a.second < b.second; };
    const std::map<std::size_t, double>& neighbours = ties_[piece];
    if (!neighbours.empty()) return std::max_element(neighbours.begin(), neighbours.end(), smaller)->first;
    if (area_[piece] > 0) return piece;
    return std::max_element(area_.begin(), area_.end(), smaller)->first;
  }
  bool is_lesser(std::size_t piece) {
    return !main_.count(piece) || !(area_[piece] > 0) || area_[piece] < min_area_;
  }
  void join(std::size_t piece, std::size_t host) {
    lesser_.erase({area_[host], host});
    const bool is_main = main_.count(host) > 0 || main_.count(piece) > 0;
    const std::size_t root = std::min(piece, host), gone = std::max(piece, host);
    pieces_.join(root, gone);
    area_[root] += area_[gone];
    area_.erase(gone);
    main_.erase(gone);
    if (is_main) main_.insert(root);
    for (const auto& [n, tie] : ties_[gone]) {
      ties_[n].erase(gone);
      if (n == root) continue;
      ties_[n][root] += tie;
      ties_[root][n] += tie;
    }
    ties_.erase(gone);
    if (is_lesser(root)) lesser_.insert({area_[root], root});
  }

  DisjointSets pieces_;
  std::size_t count_;
  double min_area_;
  std::map<std::size_t, double> area_;                         ///< per piece
  std::map<std::size_t, std::map<std::size_t, double>> ties_;  ///< per pair of neighbouring pieces, both ways
  std::set<std::size_t> main_;                                 ///< the largest piece of each part
  std::set<std::pair<double, std::size_t>> lesser_;            ///< area and piece, to join a neighbour
};

}  // namespace

double concavity(const SurfaceLink& link) {
  return std::clamp(-link.bend / (std::numbers::pi / 2), 0.0, 1.0);
}

double cutting_cost(const SurfaceLink& link) {
  return link.length / (1 + (cutting_factor - 1) * concavity(link));
}

std::vector<std::int32_t> with_smooth_boundaries(const SurfaceGraph& graph, std::vector<std::int32_t> part,
                                                 const std::vector<char>& fixed) {
  return BoundarySmoother(graph, std::move(part), fixed).run();
}

std::vector<std::int32_t> merge_small_segments(const SurfaceGraph& graph,
                                               const std::vector<std::int32_t>& part, double min_area) {
  return SmallSegmentMerger(graph, part, min_area).run();
}

}  // namespace stackabilization::detail
