#include "deformation/controllers/vertex_shares.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <set>

#include "core/index.h"
#include "deformation/controllers/seam_end.h"
#include "deformation/model/joint_slides.h"
#include "deformation/model/straight_curve.h"
#include "mesh/surface_moments.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {

namespace {

/// Reach of a part beyond its border with another part, fraction of the diagonal of the smaller of the two.
constexpr double reach_of_parts = 0.15;
/// The same in smooth designs: further away from a joint, members that move differently would bend each
/// other.
constexpr double smooth_reach_of_parts = 0.03;
/// The same for a curved part that is attached to another one, as a handle: it may bend a little.
constexpr double curved_reach_of_parts = 0.1;
/// How far a seam takes the surface of its carrier along, the same fraction; and how far the attached part is
/// trimmed, but not farther than the seam is long.
constexpr double reach_of_seams = 0.2;
/// Least lead of a part that is attached to another, see `lead_at`.
constexpr double attached = 0.3;

/// Returns a smooth weight: 1 at 0, 0 from 1 on, flat at both ends.
double fall_off(double t) {
  return t >= 1 ? 0 : 1 - t * t * (3 - 2 * t);
}

/// Weight of each part in a vertex.
using Weights = std::map<int, double>;
/// Distances of vertices along the edges.
using Distances = std::map<int, double>;

/// A connected piece of the border that a part shares with another one, as seen from the part.
struct Seam {
  int part = 0, other = 0;
  std::vector<int> vertices;  ///< ascending
  double lead = 0;            ///< of the part, see `lead_at`
};

/// Computes the weight (share) of every part in every vertex.
class Shares {
 public:
  /// `smooth`: the structure of a smooth design, null for others.
  Shares(const Shape& shape, const Structure* smooth)
      : shape_(shape),
        smooth_(smooth),
        owners_(at(static_cast<int>(shape.vertex_count()))),
        triangles_(shape.part_names.size()),
        vertices_(triangles_.size()),
        boxes_(triangles_.size()) {
    for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
      const std::int32_t part = shape.triangle_part[static_cast<std::size_t>(t)];
      triangles_[at(part)].push_back(t);
      for (int k = 0; k < 3; ++k) {
        owners_[at(shape.triangles(t, k))].insert(part);
        vertices_[at(part)].insert(shape.triangles(t, k));
        boxes_[at(part)].extend(shape.corner(t, k));
      }
    }
  }

  VertexShares all() {
    VertexShares result;
    std::vector<Weights>& shares = result.of_vertex;
    shares.resize(owners_.size());
    for (std::size_t v = 0; v < owners_.size(); ++v)
      for (const int part : owners_[v]) shares[v][part] = 1;
    const std::map<int, std::vector<Seam>> seams = seams_of_parts();
    std::vector<Weights> kept(owners_.size());
    for (const auto& [part, of_part] : seams) {
      const Edges edges = edges_of(part);
      for (const Seam& seam : of_part) spread(seam, edges, shares, kept);
    }
    for (std::size_t v = 0; v < owners_.size(); ++v) {
      for (const auto& [part, share] : kept[v]) shares[v][part] *= share;
      double sum = 0;
      for (const auto& [part, share] : shares[v]) sum += share;
      // Parts that are attached to each other in a ring own their common vertices in equal shares.
      if (!(sum > 0))
        for (const int part : owners_[v]) shares[v][part] = 1, sum += 1;
      std::erase_if(shares[v], [](const auto& share) { return share.second == 0; });
      for (auto& [part, share] : shares[v]) share /= sum;
    }
    if (smooth_)
      for (const auto& [carrier, of_carrier] : seams) carry(of_carrier, shares, result.seams);
    return result;
  }

 private:
  using Edges = std::map<int, std::set<int>>;

  /// Returns the seams of each part that shares vertices.
  std::map<int, std::vector<Seam>> seams_of_parts() const {
    std::map<int, std::map<int, std::set<int>>> borders;
    for (std::size_t v = 0; v < owners_.size(); ++v)
      for (const int part : owners_[v])
        for (const int other : owners_[v])
          if (other != part) borders[part][other].insert(static_cast<int>(v));
    std::map<int, std::vector<Seam>> seams;
    for (const auto& [part, of_part] : borders) {
      const Edges edges = edges_of(part);
      for (const auto& [other, border] : of_part)
        for (std::vector<int>& piece : connected_pieces(border, edges))
          seams[part].push_back({part, other, std::move(piece)});
    }
    if (!smooth_) return seams;
    for (auto& [part, of_part] : seams)
      for (Seam& seam : of_part) seam.lead = lead_at(seam);
    return seams;
  }

  static std::vector<std::vector<int>> connected_pieces(std::set<int> left, const Edges& edges) {
    std::vector<std::vector<int>> pieces;
    while (!left.empty()) {
      std::vector<int> piece{*left.begin()};
      left.erase(left.begin());
      for (std::size_t k = 0; k < piece.size(); ++k)
        for (const int next : edges.at(piece[k]))
          if (left.erase(next) > 0) piece.push_back(next);
      std::sort(piece.begin(), piece.end());
      pieces.push_back(std::move(piece));
    }
    return pieces;
  }

  /// Extends the weight of the other part at a seam into the part. `edges`: of the part; `kept`: factors that
  /// parts keep of their own weights.
  void spread(const Seam& seam, const Edges& edges, std::vector<Weights>& shares,
              std::vector<Weights>& kept) const {
    if (seam.lead < -attached) return;
    const double reach = blended_reach(seam) * smaller_diagonal(seam);
    for (const auto& [vertex, distance] : distances(edges, seam.vertices, reach)) {
      const double weight = fall_off(distance / reach);
      if (seam.lead > attached) kept[at(vertex)].try_emplace(seam.part, 1).first->second *= 1 - weight;
      // What a part shares with another carrier follows that one alone.
      if (seam.lead > attached && distance > 0 && owners_[at(vertex)].size() > 1) continue;
      double& share = shares[at(vertex)][seam.other];
      share = std::max(share, weight);
    }
  }

  double blended_reach(const Seam& seam) const {
    if (!smooth_) return reach_of_parts;
    const auto* cylinder = std::get_if<GeneralizedCylinder>(&smooth_->parts[at(seam.part)].primitive);
    const bool bends = cylinder && !is_straight(*cylinder) && seam.lead > attached;
    return bends ? curved_reach_of_parts : smooth_reach_of_parts;
  }

  /// A seam with the vertices within its reach.
  struct SeamReach {
    CarriedSeam carried;
    double around = 0, trim = 0;  ///< reaches on the carrier and on the attached part, model units
    Distances on_carrier, on_attached;
  };
  /// Sums of the inverse squares of the distances to all seams of a part that reach a vertex.
  using Nearness = std::map<int, double>;

  /// Lets the vertices around the seams of a carrier follow the parts that are attached there.
  void carry(const std::vector<Seam>& of_carrier, const std::vector<Weights>& shares,
             std::vector<CarriedSeam>& carried) const {
    // Between seams, their shares are those of the interpolation of Shepard (1968).
    std::vector<SeamReach> reaches;
    Nearness near_carrier;
    std::map<int, Nearness> near_attached;
    for (const Seam& seam : of_carrier) {
      if (!(seam.lead < -attached)) continue;
      const SeamReach& reach = reaches.emplace_back(reach_of(seam));
      for (const auto& [vertex, distance] : reach.on_carrier)
        near_carrier[vertex] += shepard_weight(distance);
      for (const auto& [vertex, distance] : reach.on_attached)
        near_attached[seam.other][vertex] += shepard_weight(distance);
    }
    if (reaches.empty()) return;
    const std::map<int, std::vector<Eigen::Vector3d>> normals = normals_of(reaches.front().carried.carrier);
    for (SeamReach& reach : reaches) {
      take_along(reach, near_carrier, normals, shares);
      trim(reach, near_attached.at(reach.carried.attached), shares);
      std::sort(reach.carried.around.begin(), reach.carried.around.end());
      carried.push_back(std::move(reach.carried));
    }
  }

  SeamReach reach_of(const Seam& seam) const {
    const double smaller = smaller_diagonal(seam);
    Eigen::AlignedBox3d box;
    for (const int vertex : seam.vertices) box.extend(shape_.vertices.row(vertex).transpose());
    SeamReach reach;
    reach.around = reach_of_seams * smaller;
    reach.trim = std::min(box.diagonal().norm(), reach.around);
    reach.carried = {
        seam.other, seam.part, middle_of(seam.vertices), reach.trim * end_at(seam, seam.other).axis, {}, {}};
    reach.on_carrier = distances(edges_of(seam.part), seam.vertices, reach.around);
    reach.on_attached =
        distances(edges_of(seam.other), seam.vertices, std::max(reach.trim, curved_reach_of_parts * smaller));
    return reach;
  }

  /// Finds the vertices of the carrier that a seam takes along.
  void take_along(SeamReach& reach, const Nearness& nearness,
                  const std::map<int, std::vector<Eigen::Vector3d>>& normals,
                  const std::vector<Weights>& shares) const {
    CarriedSeam& seam = reach.carried;
    const Primitive& carrier = smooth_->parts[at(seam.carrier)].primitive;
    const Eigen::Matrix3d sliding =
        Eigen::Matrix3d::Identity() - held_directions(carrier, seam.point, sliding_ways(carrier, seam.point));
    for (const auto& [vertex, distance] : reach.on_carrier) {
      // A seam slides along the surface around it: what lies across the slide, as a rim does, stays.
      double across = 0;
      if (distance > 0)
        for (const Eigen::Vector3d& normal : normals.at(vertex))
          across = std::max(across, (sliding * normal).squaredNorm());
      const double own = shepard_weight(distance) / nearness.at(vertex);
      const double share = share_of(shares[at(vertex)], seam.carrier) * own *
                           fall_off(distance / reach.around) * std::max(1 - across, 0.0);
      if (share > 0) seam.around.emplace_back(vertex, share);
    }
  }

  /// Finds the vertices of the attached part that are trimmed to the carrier, and lets those that follow it
  /// slide with the seam. Those of other seams follow these.
  void trim(SeamReach& reach, const Nearness& nearness, const std::vector<Weights>& shares) const {
    CarriedSeam& seam = reach.carried;
    for (const auto& [vertex, distance] : reach.on_attached) {
      if (owners_[at(vertex)].size() > 1) continue;
      const double own = shepard_weight(distance) / nearness.at(vertex);
      const double whole = own * share_of(shares[at(vertex)], seam.carrier),
                   along = own * fall_off(distance / reach.trim);
      if (whole > 0) seam.around.emplace_back(vertex, whole);
      if (along > whole) seam.trimmed.emplace_back(vertex, along - whole);
    }
  }

  Eigen::Vector3d middle_of(const std::vector<int>& vertices) const {
    return shape_.vertices(vertices, Eigen::all).colwise().mean().transpose();
  }

  /// Returns the inverse square of a distance, finite at 0.
  double shepard_weight(double distance) const {
    const double least = tolerance::relative * smooth_->diagonal;
    return 1 / std::max(distance * distance, least * least);
  }

  static double share_of(const Weights& weights, int part) {
    const auto found = weights.find(part);
    return found == weights.end() ? 0 : found->second;
  }

  /// Returns the unit normals of the triangles of a part around its vertices.
  std::map<int, std::vector<Eigen::Vector3d>> normals_of(int part) const {
    std::map<int, std::vector<Eigen::Vector3d>> normals;
    for (const Eigen::Index t : triangles_[at(part)])
      for (int k = 0; k < 3; ++k)
        normals[shape_.triangles(t, k)].push_back(area_vector(shape_, t).stableNormalized());
    return normals;
  }

  /// Returns by how much more the part of a seam ends there than the other one. From `attached` on it is
  /// attached to the other and follows it there. The carrier of a joint that slides is no end.
  double lead_at(const Seam& seam) const {
    const Relation* nearest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const Relation& relation : smooth_->relations) {
      if (!relation.is_joint() ||
          std::minmax(relation.parts[0], relation.parts[1]) != std::minmax(seam.part, seam.other))
        continue;
      const double distance =
          (relation.points.rowwise() - middle_of(seam.vertices).transpose()).rowwise().norm().minCoeff();
      if (distance < least) nearest = &relation, least = distance;
    }
    if (nearest && slides_whole(*nearest)) return nearest->carrier == seam.other ? 1 : -1;
    const double ends = end_at(seam, seam.part).share - end_at(seam, seam.other).share;
    if (std::abs(ends) > attached) return ends;
    // Neither ends there, or both do: the smaller one is attached, as a handle along its side.
    const double own = diagonal_of(seam.part), other = diagonal_of(seam.other);
    return (other - own) / std::max(own, other);
  }

  static bool slides_whole(const Relation& joint) {
    for (Eigen::Index point = 0; point < joint.points.rows(); ++point)
      if (!joint.slides(point)) return false;
    return true;
  }

  SeamEnd end_at(const Seam& seam, int part) const {
    const std::set<int>& own = vertices_[at(part)];
    return seam_end(smooth_->parts[at(part)].primitive,
                    shape_.vertices(std::vector<int>(own.begin(), own.end()), Eigen::all),
                    shape_.vertices(seam.vertices, Eigen::all));
  }

  Edges edges_of(int part) const {
    Edges edges;
    for (const Eigen::Index t : triangles_[at(part)])
      for (int k = 0; k < 3; ++k) {
        const int a = shape_.triangles(t, k), b = shape_.triangles(t, (k + 1) % 3);
        edges[a].insert(b);
        edges[b].insert(a);
      }
    return edges;
  }

  double smaller_diagonal(const Seam& seam) const {
    return std::min(diagonal_of(seam.part), diagonal_of(seam.other));
  }

  double diagonal_of(int part) const { return boxes_[at(part)].diagonal().norm(); }

  /// Returns the distances along the edges from the vertices `from`, up to `most`, by the algorithm of
  /// Dijkstra.
  Distances distances(const Edges& edges, const std::vector<int>& from, double most) const {
    Distances settled;
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (const int vertex : from) queue.emplace(0, vertex);
    while (!queue.empty()) {
      const auto [distance, vertex] = queue.top();
      queue.pop();
      if (distance >= most || !settled.emplace(vertex, distance).second) continue;
      for (const int next : edges.at(vertex))
        if (!settled.contains(next))
          queue.emplace(distance + (shape_.vertices.row(next) - shape_.vertices.row(vertex)).norm(), next);
    }
    return settled;
  }

  const Shape& shape_;
  const Structure* smooth_;
  std::vector<std::set<int>> owners_;                 ///< parts whose triangles use the vertex
  std::vector<std::vector<Eigen::Index>> triangles_;  ///< per part
  std::vector<std::set<int>> vertices_;               ///< per part
  std::vector<Eigen::AlignedBox3d> boxes_;            ///< per part
};

}  // namespace

VertexShares vertex_shares(const Shape& shape, const Structure* smooth) {
  return Shares(shape, smooth).all();
}

}  // namespace stackabilization::detail
