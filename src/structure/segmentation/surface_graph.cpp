#include "structure/segmentation/surface_graph.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

#include "core/angles.h"
#include "core/disjoint_sets.h"
#include "core/index.h"
#include "mesh/edge_table.h"
#include "mesh/oriented_mesh.h"
#include "mesh/surface_index.h"
#include "mesh/welded_mesh.h"
#include "structure/segmentation/flat_triangles.h"

namespace stackabilization::detail {

namespace {

class GraphBuilder {
 public:
  explicit GraphBuilder(const Shape& shape)
      : shape_(shape),
        mesh_(weld(shape)),
        first_copies_(mesh_.first_copies()),
        edges_(collapse_copies()),
        joined_(static_cast<std::size_t>(shape.triangle_count())) {}

  SurfaceGraph run() {
    measure();
    turn_outward();
    level_flat_triangles();
    link_copies();
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
  const Triangles& collapse_copies();
  void measure();
  void turn_outward();
  void level_flat_triangles();
  void link_copies();
  void link_across_edges();
  void link_across_points();
  void link(std::int32_t a, std::int32_t b, double length, double bend) {
    graph_.links.push_back({a, b, length, bend});
    joined_.join(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
  }
  double bend(const TriangleSide& a, const TriangleSide& b) const;

  const Shape& shape_;
  WeldedMesh mesh_;  ///< copies are collapsed, so that they have no edges
  std::vector<std::int32_t> first_copies_;
  EdgeTable edges_;
  DisjointSets joined_;
  SurfaceGraph graph_;
};

const Triangles& GraphBuilder::collapse_copies() {
  for (std::int32_t t = 0; t < mesh_.triangles.rows(); ++t)
    if (first_copies_[at(t)] != t) mesh_.triangles.row(t).setConstant(mesh_.triangles(t, 0));
  return mesh_.triangles;
}

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

/// Gives flat triangles the normal of the surface beside their longest edge.
void GraphBuilder::level_flat_triangles() {
  const std::vector<FlatTriangle> flat = flat_triangles(mesh_, edges_);
  std::vector<char> unknown(at(static_cast<std::int32_t>(shape_.triangle_count())), 0);
  for (const FlatTriangle& one : flat) unknown[at(one.row)] = 1;
  for (const FlatTriangle& one : flat)
    for (const TriangleSide& side : edges_[one.edge]) {
      if (unknown[at(side.triangle)]) continue;
      graph_.normals.row(one.row) = graph_.normals.row(side.triangle);
      unknown[at(one.row)] = 0;
      break;
    }
}

void GraphBuilder::link_copies() {
  for (std::int32_t t = 0; t < shape_.triangle_count(); ++t) {
    const std::int32_t first = first_copies_[at(t)];
    if (first == t) continue;
    graph_.areas(t) = graph_.areas(first);
    graph_.normals.row(t) = graph_.normals.row(first);
    double perimeter = 0;
    for (int k = 0; k < 3; ++k) perimeter += (shape_.corner(t, (k + 1) % 3) - shape_.corner(t, k)).norm();
    link(first, t, perimeter, 0);
  }
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

/// Shells hang on so many of the largest ones. In a soup of triangles every shell is one.
constexpr std::size_t max_hosts = 64;

/// A connected piece of surface.
struct Shell {
  std::vector<std::int32_t> rows;  ///< triangles
  double area = 0;
  Eigen::AlignedBox3d box;
  std::optional<SurfaceIndex> index;  ///< none without area, and of small ones
};

/// Where a triangle comes nearest to another shell.
struct ShellContact {
  double distance = std::numeric_limits<double>::infinity();
  std::int32_t from = -1, onto = -1;
};

/// Returns the shells of a shape, the largest first, and equal ones by their first triangles.
std::vector<Shell> shells_by_area(const SurfaceGraph& graph, const Shape& shape) {
  const std::vector<std::int32_t> shell = connected_components(weld(shape));
  std::vector<Shell> shells(static_cast<std::size_t>(*std::max_element(shell.begin(), shell.end())) + 1);
  for (std::size_t t = 0; t < shell.size(); ++t) {
    Shell& of = shells[static_cast<std::size_t>(shell[t])];
    const auto row = static_cast<std::int32_t>(t);
    of.rows.push_back(row);
    of.area += graph.areas(row);
    for (int k = 0; k < 3; ++k) of.box.extend(shape.corner(row, k));
  }
  if (shells.size() == 1) return shells;
  std::stable_sort(shells.begin(), shells.end(),
                   [](const Shell& a, const Shell& b) { return a.area > b.area; });
  for (std::size_t s = 0; s < std::min(shells.size(), max_hosts); ++s)
    if (shells[s].area > 0) shells[s].index.emplace(extracted(shape, shells[s].rows));
  return shells;
}

/// Returns where `point`, of triangle `from`, comes nearest to one of `others`, to the first one of equals.
ShellContact nearest_contact(std::int32_t from, const Eigen::Vector3d& point, std::span<const Shell> others) {
  ShellContact nearest;
  for (const Shell& other : others) {
    if (!other.index || other.box.exteriorDistance(point) >= nearest.distance) continue;
    const SurfacePoint found = other.index->nearest(point);
    if (found.distance < nearest.distance)
      nearest = {found.distance, from, other.rows[static_cast<std::size_t>(found.triangle)]};
  }
  return nearest;
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

void add_links(SurfaceGraph& graph, const std::vector<SurfaceLink>& links) {
  for (const SurfaceLink& link : links) {
    for (const std::int32_t end : {link.a, link.b})
      graph.links_of[at(end)].push_back(static_cast<std::int32_t>(graph.links.size()));
    graph.links.push_back(link);
  }
}

void link_shells(SurfaceGraph& graph, const Shape& shape, double reach) {
  const std::vector<Shell> shells = shells_by_area(graph, shape);
  const auto add = [&](const ShellContact& contact) {
    add_links(graph, {{contact.from, contact.onto, std::sqrt(graph.areas(contact.from)), 0}});
  };
  for (std::size_t s = 1; s < shells.size(); ++s) {
    const std::span<const Shell> hosts = std::span(shells).first(std::min(s, max_hosts));
    ShellContact nearest;
    for (const std::int32_t t : shells[s].rows) {
      const ShellContact contact = nearest_contact(t, graph.centres.row(t).transpose(), hosts);
      if (contact.distance < nearest.distance) nearest = contact;
      if (contact.distance <= reach) add(contact);
    }
    if (nearest.from >= 0 && nearest.distance > reach) add(nearest);
  }
}

}  // namespace stackabilization::detail
