#include "structure/segmentation/surface_graph.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "core/angles.h"
#include "core/disjoint_sets.h"
#include "core/index.h"
#include "mesh/edge_table.h"
#include "mesh/oriented_mesh.h"
#include "mesh/surface_index.h"
#include "mesh/welded_mesh.h"

namespace stackabilization::detail {

namespace {

class GraphBuilder {
 public:
  explicit GraphBuilder(const Shape& shape)
      : shape_(shape),
        mesh_(weld(shape)),
        edges_(mesh_.triangles),
        joined_(static_cast<std::size_t>(shape.triangle_count())) {}

  SurfaceGraph run() {
    measure();
    turn_outward();
    link_across_edges();
    link_across_points();
    graph_.links_of.resize(static_cast<std::size_t>(shape_.triangle_count()));
    for (std::size_t l = 0; l < graph_.links.size(); ++l) {
      graph_.links_of[static_cast<std::size_t>(graph_.links[l].a)].push_back(static_cast<std::int32_t>(l));
      graph_.links_of[static_cast<std::size_t>(graph_.links[l].b)].push_back(static_cast<std::int32_t>(l));
    }
    return std::move(graph_);
  }

 private:
  void measure();
  void turn_outward();
  void link_across_edges();
  void link_across_points();
  void link(std::int32_t a, std::int32_t b, double length, double bend) {
    graph_.links.push_back({a, b, length, bend});
    joined_.join(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
  }
  double bend(const TriangleSide& a, const TriangleSide& b) const;

  const Shape& shape_;
  WeldedMesh mesh_;
  EdgeTable edges_;
  DisjointSets joined_;
  SurfaceGraph graph_;
};

/// Normals are those of the half-edge mesh, where neighbours agree.
void GraphBuilder::measure() {
  const Eigen::Index m = shape_.triangle_count();
  graph_.areas = Eigen::VectorXd::Zero(m);
  graph_.centres.resize(m, 3);
  graph_.normals = Points::Zero(m, 3);
  Eigen::AlignedBox3d box;
  for (Eigen::Index t = 0; t < m; ++t) {
    graph_.centres.row(t) = (shape_.corner(t, 0) + shape_.corner(t, 1) + shape_.corner(t, 2)).transpose() / 3;
    for (int k = 0; k < 3; ++k) box.extend(shape_.corner(t, k));
  }
  graph_.diagonal = box.diagonal().norm();
  const OrientedMesh surface = orient(mesh_);
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    std::array<Eigen::Vector3d, 3> p;
    for (int k = 0; k < 3; ++k)
      p[static_cast<std::size_t>(k)] = surface.points.row(surface.triangles(f, k)).transpose();
    const Eigen::Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
    const Eigen::Index t = surface.source[static_cast<std::size_t>(f)];
    const double length = normal.stableNorm();
    if (!(length > 0)) continue;
    graph_.areas(t) = length / 2;
    graph_.normals.row(t) = normal.transpose() / length;
  }
}

void GraphBuilder::turn_outward() {
  DisjointSets pieces(static_cast<std::size_t>(shape_.triangle_count()));
  for (std::size_t e = 0; e < edges_.size(); ++e)
    if (edges_[e].size() == 2) pieces.join(at(edges_[e][0].triangle), at(edges_[e][1].triangle));
  const Eigen::Index m = shape_.triangle_count();
  Points moment = Points::Zero(m, 3);
  Eigen::VectorXd area = Eigen::VectorXd::Zero(m), volume = Eigen::VectorXd::Zero(m);
  const auto piece = [&](Eigen::Index t) {
    return static_cast<Eigen::Index>(pieces.root(static_cast<std::size_t>(t)));
  };
  for (Eigen::Index t = 0; t < m; ++t) {
    moment.row(piece(t)) += graph_.areas(t) * graph_.centres.row(t);
    area(piece(t)) += graph_.areas(t);
  }
  for (Eigen::Index t = 0; t < m; ++t) {
    const Eigen::Index p = piece(t);
    if (area(p) > 0)
      volume(p) +=
          graph_.areas(t) * (graph_.centres.row(t) - moment.row(p) / area(p)).dot(graph_.normals.row(t));
  }
  for (Eigen::Index t = 0; t < m; ++t)
    if (volume(piece(t)) < 0) graph_.normals.row(t) *= -1;
}

double GraphBuilder::bend(const TriangleSide& a, const TriangleSide& b) const {
  const Eigen::Vector3d n = graph_.normals.row(a.triangle), m = graph_.normals.row(b.triangle);
  if (n.isZero(0) || m.isZero(0)) return 0;
  const double angle = angle_between(n, m);
  const Eigen::Vector3d across =
      (graph_.centres.row(b.triangle) - graph_.centres.row(a.triangle)).transpose();
  return across.dot(n - m) <= 0 ? angle : -angle;
}

void GraphBuilder::link_across_edges() {
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const std::span<const TriangleSide> sides = edges_[e];
    for (std::size_t s = 0; s + 1 < sides.size(); ++s) {
      const TriangleSide &a = sides[s], &b = sides[s + 1];
      const double length =
          (shape_.corner(a.triangle, a.corner) - shape_.corner(a.triangle, (a.corner + 1) % 3)).norm();
      // Where sheets meet, no outside distinguishes convex from concave edges: a corner is concave on at
      // least one side.
      double angle = bend(a, b);
      if (sides.size() > 2) angle = -std::min(std::abs(angle), std::numbers::pi - std::abs(angle));
      link(a.triangle, b.triangle, length, angle);
    }
  }
}

void GraphBuilder::link_across_points() {
  std::vector<std::int32_t> first(static_cast<std::size_t>(mesh_.points.rows()),
                                  -1);  // triangle at each point
  for (std::int32_t t = 0; t < shape_.triangle_count(); ++t)
    for (const std::int32_t point : mesh_.triangles.row(t)) {
      std::int32_t& known = first[at(point)];
      if (known < 0) known = t;
      if (joined_.root(at(known)) != joined_.root(at(t))) link(known, t, 0, 0);
    }
}

}  // namespace

SurfaceGraph surface_graph(const Shape& shape) {
  return GraphBuilder(shape).run();
}

Shape extracted(const Shape& shape, const std::vector<std::int32_t>& rows) {
  Shape piece;
  piece.part_names = {"piece"};
  piece.triangle_part.assign(rows.size(), 0);
  piece.unit = shape.unit;
  piece.triangles.resize(static_cast<Eigen::Index>(rows.size()), 3);
  std::vector<std::int32_t> used;
  for (const std::int32_t row : rows)
    for (int k = 0; k < 3; ++k) used.push_back(shape.triangles(row, k));
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  piece.vertices.resize(static_cast<Eigen::Index>(used.size()), 3);
  for (std::size_t v = 0; v < used.size(); ++v)
    piece.vertices.row(static_cast<Eigen::Index>(v)) = shape.vertices.row(used[v]);
  for (std::size_t t = 0; t < rows.size(); ++t)
    for (int k = 0; k < 3; ++k)
      piece.triangles(static_cast<Eigen::Index>(t), k) = static_cast<std::int32_t>(
          std::lower_bound(used.begin(), used.end(), shape.triangles(rows[t], k)) - used.begin());
  return piece;
}

void link_shells(SurfaceGraph& graph, const Shape& shape, double reach) {
  const std::vector<std::int32_t> shell = connected_components(weld(shape));
  const auto count = static_cast<std::size_t>(*std::max_element(shell.begin(), shell.end())) + 1;
  if (count == 1) return;
  std::vector<double> area(count, 0);
  for (std::size_t t = 0; t < shell.size(); ++t)
    area[static_cast<std::size_t>(shell[t])] += graph.areas(static_cast<Eigen::Index>(t));
  const auto largest = static_cast<std::int32_t>(std::max_element(area.begin(), area.end()) - area.begin());
  if (!(area[static_cast<std::size_t>(largest)] > 0)) return;
  std::vector<std::int32_t> host;
  for (std::size_t t = 0; t < shell.size(); ++t)
    if (shell[t] == largest) host.push_back(static_cast<std::int32_t>(t));

  struct Contact {
    double distance = std::numeric_limits<double>::infinity();
    std::int32_t from = -1, onto = -1;
  };
  const SurfaceIndex index(extracted(shape, host));
  const auto add = [&](const Contact& contact) {
    for (const std::int32_t end : {contact.from, contact.onto})
      graph.links_of[static_cast<std::size_t>(end)].push_back(static_cast<std::int32_t>(graph.links.size()));
    graph.links.push_back({contact.from, contact.onto, std::sqrt(graph.areas(contact.from)), 0});
  };
  std::vector<Contact> nearest(count);
  for (std::size_t t = 0; t < shell.size(); ++t) {
    if (shell[t] == largest) continue;
    const SurfacePoint found = index.nearest(graph.centres.row(static_cast<Eigen::Index>(t)).transpose());
    const Contact contact{found.distance, static_cast<std::int32_t>(t),
                          host[static_cast<std::size_t>(found.triangle)]};
    Contact& best = nearest[static_cast<std::size_t>(shell[t])];
    if (contact.distance < best.distance) best = contact;
    if (contact.distance <= reach) add(contact);
  }
  for (const Contact& contact : nearest)
    if (contact.from >= 0 && contact.distance > reach) add(contact);
}

}  // namespace stackabilization::detail
