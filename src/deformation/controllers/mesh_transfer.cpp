#include "deformation/controllers/mesh_transfer.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <queue>
#include <set>

#include "core/index.h"

namespace stackabilization::detail {

namespace {

/// Reach of a part beyond its border with another part, fraction of the diagonal of the smaller of the two.
constexpr double reach_of_parts = 0.15;
/// The same in smooth designs: further away from a joint, members that move differently would bend each
/// other.
constexpr double smooth_reach_of_parts = 0.03;
/// Least lead of a part that is attached to another, see `lead_of`.
constexpr double attached = 0.3;

/// Returns a smooth weight: 1 at 0, 0 from 1 on, flat at both ends.
double fall_off(double t) {
  return t >= 1 ? 0 : 1 - t * t * (3 - 2 * t);
}

bool equal(const Primitive& a, const Primitive& b) {
  if (const auto* cuboid = std::get_if<Cuboid>(&a)) return cuboid->corners == std::get<Cuboid>(b).corners;
  const auto &p = std::get<GeneralizedCylinder>(a), &q = std::get<GeneralizedCylinder>(b);
  return p.centres == q.centres && p.radii == q.radii && p.rotation.coeffs() == q.rotation.coeffs();
}

/// Computes the weight (share) of every part in every vertex.
class Shares {
 public:
  /// Weight of each part to which a vertex is bound.
  using PerVertex = std::map<int, double>;

  /// `smooth`: the structure of a smooth design, null for others.
  Shares(const Shape& shape, const Structure* smooth)
      : shape_(shape),
        smooth_(smooth),
        owners_(at(static_cast<int>(shape.vertex_count()))),
        triangles_(shape.part_names.size()),
        boxes_(triangles_.size()) {
    for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
      const std::int32_t part = shape.triangle_part[static_cast<std::size_t>(t)];
      triangles_[at(part)].push_back(t);
      for (int k = 0; k < 3; ++k) {
        owners_[at(shape.triangles(t, k))].insert(part);
        boxes_[at(part)].extend(shape.corner(t, k));
      }
    }
  }

  std::vector<PerVertex> all() {
    std::vector<PerVertex> shares(owners_.size());
    for (std::size_t v = 0; v < owners_.size(); ++v)
      for (const int part : owners_[v]) shares[v][part] = 1;
    const std::map<int, Borders> all_borders = borders();
    for (const auto& [part, borders] : all_borders) spread_into(part, borders, shares);
    for (std::size_t v = 0; v < owners_.size(); ++v) {
      double sum = 0;
      for (const auto& [part, share] : shares[v]) sum += share;
      // Parts that are attached to each other in a ring own their common vertices in equal shares.
      if (!(sum > 0))
        for (const int part : owners_[v]) shares[v][part] = 1, sum += 1;
      std::erase_if(shares[v], [](const auto& share) { return share.second == 0; });
      for (auto& [part, share] : shares[v]) share /= sum;
    }
    return shares;
  }

 private:
  /// The vertices that a part shares with each other part.
  using Borders = std::map<int, std::vector<int>>;

  /// Returns the borders of each part that shares vertices.
  std::map<int, Borders> borders() const {
    std::map<int, Borders> borders;
    for (std::size_t v = 0; v < owners_.size(); ++v)
      for (const int part : owners_[v])
        for (const int other : owners_[v])
          if (other != part) borders[part][other].push_back(static_cast<int>(v));
    return borders;
  }

  /// Extends the weights of the parts that share vertices with `part` into it.
  void spread_into(int part, const Borders& borders, std::vector<PerVertex>& shares) const {
    const std::map<int, std::set<int>> edges = edges_of(part);
    for (const auto& [other, border] : borders) {
      const double lead = smooth_ ? lead_of(border_place(part, border), border_place(other, border)) : 0;
      if (lead < -attached) continue;
      const double fraction = smooth_ ? smooth_reach_of_parts : reach_of_parts;
      const double reach = fraction * std::min(diagonal(part), diagonal(other));
      for (const auto& [vertex, distance] : distances(edges, border, reach)) {
        const double weight = fall_off(distance / reach);
        double& share = shares[at(vertex)][other];
        share = std::max(share, weight);
        if (lead > attached) shares[at(vertex)][part] *= 1 - weight;
      }
    }
  }

  /// Where a border lies on a part.
  struct BorderPlace {
    double nearness = 0;  ///< to an end: 0 in the middle, 1 at an end
    double length = 0;    ///< along the axis of the part, share of the size of the border
  };

  /// Returns by how much more a part ends at its border than the other one. From `attached` on it is attached
  /// to the other and follows it there: its border lies nearer to its end or, where both are as near, its
  /// border lies across its axis, and along that of the other.
  static double lead_of(const BorderPlace& own, const BorderPlace& other) {
    const double nearer = own.nearness - other.nearness;
    return std::abs(nearer) > attached ? nearer : other.length - own.length;
  }

  BorderPlace border_place(int part, const std::vector<int>& border) const {
    const Points points = control_points(smooth_->parts[at(part)].primitive);
    const Eigen::RowVector3d middle = points.colwise().mean();
    const Eigen::Matrix3d spread = (points.rowwise() - middle).transpose() * (points.rowwise() - middle);
    const Eigen::Vector3d axis = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(2);
    const Points places = shape_.vertices(border, Eigen::all);
    const Eigen::RowVector3d size = places.colwise().maxCoeff() - places.colwise().minCoeff();
    const Eigen::VectorXd heights = (places.rowwise() - middle) * axis;
    const Eigen::VectorXd own = (points.rowwise() - middle) * axis;
    const double half = own.cwiseAbs().maxCoeff();
    BorderPlace place;
    place.nearness = std::min(std::abs(heights.mean()) / half, 1.0);
    if (size.norm() > 0) place.length = (heights.maxCoeff() - heights.minCoeff()) / size.norm();
    return place;
  }

  std::map<int, std::set<int>> edges_of(int part) const {
    std::map<int, std::set<int>> edges;
    for (const Eigen::Index t : triangles_[at(part)])
      for (int k = 0; k < 3; ++k) {
        const int a = shape_.triangles(t, k), b = shape_.triangles(t, (k + 1) % 3);
        edges[a].insert(b);
        edges[b].insert(a);
      }
    return edges;
  }

  double diagonal(int part) const { return boxes_[at(part)].diagonal().norm(); }

  /// Returns the distances along the edges from the vertices `from`, up to `most`, by the algorithm of
  /// Dijkstra.
  std::map<int, double> distances(const std::map<int, std::set<int>>& edges, const std::vector<int>& from,
                                  double most) const {
    std::map<int, double> settled;
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
  std::vector<Eigen::AlignedBox3d> boxes_;            ///< per part
};

}  // namespace

MeshTransfer::MeshTransfer(const Shape& shape, const Rig& rig, Following following)
    : rest_(shape.vertices), parts_(rig.primitive_bindings.size()) {
  const std::vector<Shares::PerVertex> shares =
      Shares(shape, following == Following::smooth ? &rig.rest : nullptr).all();
  for (std::size_t v = 0; v < shares.size(); ++v)
    for (const auto& [part, share] : shares[v]) {
      parts_[at(part)].vertices.push_back(static_cast<int>(v));
      parts_[at(part)].shares.push_back(share);
    }
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    Points points(static_cast<Eigen::Index>(parts_[part].vertices.size()), 3);
    for (Eigen::Index i = 0; i < points.rows(); ++i)
      points.row(i) = rest_.row(parts_[part].vertices[static_cast<std::size_t>(i)]);
    parts_[part].bindings = rig.primitive_bindings[part].bind(points);
  }
}

Points MeshTransfer::vertices(const Rig& rig, const std::vector<Primitive>& now) const {
  Points vertices = rest_;
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    if (equal(rig.primitive_bindings[part].rest(), now[part])) continue;
    const BoundPart& bound = parts_[part];
    const Points moved = rig.primitive_bindings[part].displacements(bound.bindings, now[part]);
    for (std::size_t i = 0; i < bound.vertices.size(); ++i)
      vertices.row(bound.vertices[i]) += bound.shares[i] * moved.row(static_cast<Eigen::Index>(i));
  }
  return vertices;
}

std::vector<BoundPoint> MeshTransfer::bound_points(int vertex) const {
  std::vector<BoundPoint> bound_points;
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    const BoundPart& bound = parts_[part];
    const auto found = std::lower_bound(bound.vertices.begin(), bound.vertices.end(), vertex);
    if (found == bound.vertices.end() || *found != vertex) continue;
    const auto i = static_cast<std::size_t>(found - bound.vertices.begin());
    bound_points.push_back({static_cast<int>(part), bound.bindings[i], bound.shares[i]});
  }
  return bound_points;
}

}  // namespace stackabilization::detail
