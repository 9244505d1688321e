#include "stackabilization/deformation/feature_curves.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "core/disjoint_sets.h"
#include "mesh/edge_table.h"
#include "mesh/surface_moments.h"
#include "mesh/welded_mesh.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

using Chained = std::vector<int>;

/// Cosine of a degree: segments that turn by less belong to one straight run.
const double straight_cosine = std::cos(std::numbers::pi / 180);

struct Chain {
  Chained places;
  bool closed = false;
};

void check(const FeatureCurveOptions& options) {
  for (const double value :
       {options.crease_angle, options.corner_angle, options.straight_run_ratio, options.smallest_length})
    if (!std::isfinite(value) || value < 0)
      throw UsageError("angles and lengths of feature curves must be finite and not negative");
}

Eigen::Vector3d point_at(const detail::WeldedMesh& surface, int place) {
  return surface.points.row(place).transpose();
}

Eigen::Vector3d unit_normal(const detail::WeldedMesh& surface, Eigen::Index triangle) {
  const auto at = [&](int k) { return point_at(surface, surface.triangles(triangle, k)); };
  return detail::area_vector(at(0), at(1), at(2)).stableNormalized();
}

/// The graph of feature edges.
class FeatureGraph {
 public:
  FeatureGraph(const detail::WeldedMesh& surface, const FeatureCurveOptions& options)
      : surface_(surface),
        crease_cosine_(std::cos(options.crease_angle * std::numbers::pi / 180)),
        corner_cosine_(std::cos(options.corner_angle * std::numbers::pi / 180)),
        neighbours_(static_cast<std::size_t>(surface.points.rows())),
        cut_(neighbours_.size(), 0) {
    const detail::EdgeTable edges(surface.triangles, detail::EdgeTable::Collapsed::keep);
    for (std::size_t e = 0; e < edges.size(); ++e)
      if (is_feature(edges[e])) {
        const detail::TriangleSide& side = edges[e].front();
        neighbours_[static_cast<std::size_t>(side.low)].push_back(side.high);
        neighbours_[static_cast<std::size_t>(side.high)].push_back(side.low);
      }
  }

  /// Returns chains that contain every feature edge once: first open ones between corners and loops at a
  /// corner, then other loops.
  std::vector<Chain> chains() const {
    std::vector<Chain> chains;
    std::vector<char> seen(neighbours_.size(), 0);
    for (int start = 0; start < place_count(); ++start) {
      if (neighbours(start).empty() || !is_corner(start)) continue;
      for (const int next : neighbours(start)) {
        Chain chain = walk(start, next);
        // The walk finds each open chain from both ends, and a loop at a corner in both directions: keep the
        // lexicographically smaller one.
        Chained reverse(chain.places.rbegin(), chain.places.rend());
        if (chain.closed) std::rotate(reverse.begin(), reverse.end() - 1, reverse.end());
        if (reverse < chain.places) continue;
        for (const int place : chain.places) seen[static_cast<std::size_t>(place)] = 1;
        chains.push_back(std::move(chain));
      }
    }
    for (int start = 0; start < place_count(); ++start) {
      if (neighbours(start).empty() || seen[static_cast<std::size_t>(start)]) continue;
      chains.push_back(walk(start, neighbours(start).front()));
      for (const int place : chains.back().places) seen[static_cast<std::size_t>(place)] = 1;
    }
    return chains;
  }

  /// Makes a corner of every vertex where a straight run of length `longest` or more meets a run shorter by
  /// more than the factor `ratio`.
  void cut_straight_runs(const std::vector<Chain>& chains, double longest, double ratio) {
    for (const Chain& chain : chains) {
      const std::vector<Run> runs = straight_runs(chain);
      for (std::size_t i = chain.closed ? 0 : 1; i < runs.size(); ++i) {
        const auto [less, more] = std::minmax(runs[i].length, runs[i > 0 ? i - 1 : runs.size() - 1].length);
        if (more >= longest && more > ratio * less) cut_[static_cast<std::size_t>(runs[i].start)] = 1;
      }
    }
  }

  std::size_t valence(int place) const { return neighbours(place).size(); }

 private:
  /// Consecutive segments of nearly the same direction.
  struct Run {
    int start;
    double length;
    Eigen::Vector3d direction;
  };

  /// Returns the runs of a chain in order. The runs of a loop begin at a bend; a loop without a bend has
  /// none.
  std::vector<Run> straight_runs(const Chain& chain) const {
    const std::size_t n = chain.places.size(), segments = chain.closed ? n : n - 1;
    const auto direction = [&](std::size_t i) -> Eigen::Vector3d {
      return (point(chain.places[(i + 1) % n]) - point(chain.places[i % n])).stableNormalized();
    };
    std::size_t first = 0;
    if (chain.closed) {
      while (first < n && direction(first).dot(direction(first + n - 1)) >= straight_cosine) ++first;
      if (first == n) return {};
    }
    std::vector<Run> runs;
    for (std::size_t i = first; i < first + segments; ++i) {
      const Eigen::Vector3d along = direction(i);
      if (runs.empty() || runs.back().direction.dot(along) < straight_cosine)
        runs.push_back({chain.places[i % n], 0, along});
      runs.back().length += (point(chain.places[(i + 1) % n]) - point(chain.places[i % n])).norm();
    }
    return runs;
  }

  int place_count() const { return static_cast<int>(neighbours_.size()); }
  const Chained& neighbours(int place) const { return neighbours_[static_cast<std::size_t>(place)]; }
  Eigen::Vector3d point(int place) const { return point_at(surface_, place); }

  bool is_feature(std::span<const detail::TriangleSide> sides) const {
    if (sides.size() == 1) return true;
    for (std::size_t i = 0; i < sides.size(); ++i)
      for (std::size_t j = i + 1; j < sides.size(); ++j) {
        const double turn =
            unit_normal(surface_, sides[i].triangle).dot(unit_normal(surface_, sides[j].triangle));
        // Collapsed triangles have no normal. At an edge of more than two triangles, no orientation tells
        // which one continues which.
        if (turn == 0 && (collapsed(sides[i].triangle) || collapsed(sides[j].triangle))) continue;
        const double flat = sides.size() > 2                       ? std::abs(turn)
                            : sides[i].forward == sides[j].forward ? -turn
                                                                   : turn;
        if (flat < crease_cosine_) return true;
      }
    return false;
  }

  bool collapsed(Eigen::Index triangle) const { return unit_normal(surface_, triangle).isZero(0); }

  bool is_corner(int place) const {
    const Chained& around = neighbours(place);
    if (around.size() != 2 || cut_[static_cast<std::size_t>(place)]) return true;
    const Eigen::Vector3d in = (point(place) - point(around[0])).stableNormalized();
    const Eigen::Vector3d out = (point(around[1]) - point(place)).stableNormalized();
    return in.dot(out) < corner_cosine_;
  }

  Chain walk(int start, int next) const {
    Chain chain{{start}};
    int previous = start;
    while (next != start && !is_corner(next)) {
      chain.places.push_back(next);
      const Chained& around = neighbours(next);
      previous = std::exchange(next, around[0] == previous ? around[1] : around[0]);
    }
    chain.closed = next == start;
    if (!chain.closed) chain.places.push_back(next);
    return chain;
  }

  const detail::WeldedMesh& surface_;
  double crease_cosine_, corner_cosine_;
  std::vector<Chained> neighbours_;
  std::vector<char> cut_;
};

double length_of(const detail::WeldedMesh& surface, const Chain& chain) {
  double length = 0;
  const std::size_t n = chain.places.size();
  for (std::size_t i = 0; i + (chain.closed ? 0 : 1) < n; ++i)
    length += (point_at(surface, chain.places[(i + 1) % n]) - point_at(surface, chain.places[i])).norm();
  return length;
}

/// Returns which chains are long enough to keep.
std::vector<char> significant(const detail::WeldedMesh& surface, const FeatureGraph& graph,
                              const std::vector<Chain>& chains, double smallest) {
  DisjointSets networks(static_cast<std::size_t>(surface.points.rows()));
  for (const Chain& chain : chains)
    for (const int place : chain.places)
      networks.join(static_cast<std::size_t>(chain.places.front()), static_cast<std::size_t>(place));
  std::vector<Eigen::AlignedBox3d> boxes(static_cast<std::size_t>(surface.points.rows()));
  for (int p = 0; p < surface.points.rows(); ++p)
    boxes[networks.root(static_cast<std::size_t>(p))].extend(point_at(surface, p));
  std::vector<char> keep;
  for (const Chain& chain : chains) {
    const auto& box = boxes[networks.root(static_cast<std::size_t>(chain.places.front()))];
    const bool loose = !chain.closed &&
                       std::min(graph.valence(chain.places.front()), graph.valence(chain.places.back())) == 1;
    keep.push_back(box.diagonal().norm() >= smallest && (!loose || length_of(surface, chain) >= smallest));
  }
  return keep;
}

}  // namespace

std::vector<FeatureCurve> feature_curves(const Shape& shape, const FeatureCurveOptions& options) {
  check(options);
  const detail::WeldedMesh surface = detail::weld(shape);
  FeatureGraph graph(surface, options);
  const double smallest = options.smallest_length *
                          (surface.points.colwise().maxCoeff() - surface.points.colwise().minCoeff()).norm();
  graph.cut_straight_runs(graph.chains(), smallest, options.straight_run_ratio);
  const std::vector<Chain> chains = graph.chains();
  const std::vector<char> keep = significant(surface, graph, chains, smallest);
  std::vector<FeatureCurve> curves;
  for (std::size_t i = 0; i < chains.size(); ++i) {
    if (!keep[i]) continue;
    FeatureCurve curve{{}, chains[i].closed};
    for (const int place : chains[i].places)
      curve.vertices.push_back(surface.first_vertex[static_cast<std::size_t>(place)]);
    curves.push_back(std::move(curve));
  }
  return curves;
}

}  // namespace stackabilization
