#include "structure/segmentation/surface_graph.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "core/disjoint_sets.h"
#include "mesh/half_edge_mesh.h"
#include "mesh/point_index.h"
#include "mesh/surface_index.h"

namespace stackabilization::detail {

namespace {

using CornerPlaces = std::array<std::int32_t, 3>;

struct Side {
  std::int32_t low, high, triangle;

  bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
};

/// Numbers of the corners' places: equal coordinates, equal number.
std::vector<CornerPlaces> places_of(const Shape& shape) {
  PointIndex index;
  std::vector<CornerPlaces> places(static_cast<std::size_t>(shape.triangle_count()));
  for (std::size_t t = 0; t < places.size(); ++t)
    for (int k = 0; k < 3; ++k)
      places[t][static_cast<std::size_t>(k)] = index.insert(shape.corner(static_cast<Eigen::Index>(t), k));
  return places;
}

/// Sides of the triangles that have three different corners, those along the same edge side by side.
std::vector<Side> sorted_sides(const std::vector<CornerPlaces>& places) {
  std::vector<Side> sides;
  for (std::size_t t = 0; t < places.size(); ++t) {
    const CornerPlaces& c = places[t];
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(c[k], c[(k + 1) % 3]);
      sides.push_back({low, high, static_cast<std::int32_t>(t)});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return sides;
}

/// Visits the runs of sides along one edge as half-open ranges of rows.
template <typename Visit>
void for_each_edge(const std::vector<Side>& sides, Visit visit) {
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    for (end = begin + 1; end < sides.size() && sides[end].same_edge(sides[begin]);) ++end;
    visit(begin, end);
  }
}

class GraphBuilder {
 public:
  explicit GraphBuilder(const Shape& shape)
      : shape_(shape), places_(places_of(shape)), sides_(sorted_sides(places_)), joined_(places_.size()) {}

  SurfaceGraph run() {
    measure();
    turn_outward();
    link_across_edges();
    link_across_points();
    graph_.links_of.resize(places_.size());
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
  double bend(const Side& a, const Side& b) const;

  const Shape& shape_;
  std::vector<CornerPlaces> places_;
  std::vector<Side> sides_;
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
  const ConnectedSurface surface = connected_surface(shape_);
  for (const auto face : surface.mesh.faces()) {
    std::array<Eigen::Vector3d, 3> p;
    std::size_t k = 0;
    for (const auto vertex : surface.mesh.fv_range(face)) {
      const auto& point = surface.mesh.point(vertex);
      p[k++] = {point[0], point[1], point[2]};
    }
    const Eigen::Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
    const Eigen::Index t = surface.triangle_of_face[static_cast<std::size_t>(face.idx())];
    const double length = normal.stableNorm();
    if (!(length > 0)) continue;
    graph_.areas(t) = length / 2;
    graph_.normals.row(t) = normal.transpose() / length;
  }
}

void GraphBuilder::turn_outward() {
  DisjointSets pieces(places_.size());
  for_each_edge(sides_, [&](std::size_t begin, std::size_t end) {
    if (end - begin == 2)
      pieces.join(static_cast<std::size_t>(sides_[begin].triangle),
                  static_cast<std::size_t>(sides_[begin + 1].triangle));
  });
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

double GraphBuilder::bend(const Side& a, const Side& b) const {
  const Eigen::Vector3d n = graph_.normals.row(a.triangle), m = graph_.normals.row(b.triangle);
  if (n.isZero(0) || m.isZero(0)) return 0;
  const double angle = std::atan2(n.cross(m).norm(), n.dot(m));
  const Eigen::Vector3d across =
      (graph_.centres.row(b.triangle) - graph_.centres.row(a.triangle)).transpose();
  return across.dot(n - m) <= 0 ? angle : -angle;
}

void GraphBuilder::link_across_edges() {
  for_each_edge(sides_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s + 1 < end; ++s) {
      const Side &a = sides_[s], &b = sides_[s + 1];
      const CornerPlaces& corners = places_[static_cast<std::size_t>(a.triangle)];
      const auto corner = [&](std::int32_t place) {
        const auto k = std::find(corners.begin(), corners.end(), place) - corners.begin();
        return shape_.corner(a.triangle, static_cast<int>(k));
      };
      // Where sheets meet there is no outside to tell convex from concave by: a corner on one side at least
      // is concave.
      double angle = bend(a, b);
      if (end - begin > 2) angle = -std::min(std::abs(angle), std::numbers::pi - std::abs(angle));
      link(a.triangle, b.triangle, (corner(a.low) - corner(a.high)).norm(), angle);
    }
  });
}

void GraphBuilder::link_across_points() {
  std::vector<std::int32_t> first(3 * places_.size(), -1);  // per place the first triangle there
  for (std::size_t t = 0; t < places_.size(); ++t)
    for (const std::int32_t place : places_[t]) {
      std::int32_t& known = first[static_cast<std::size_t>(place)];
      if (known < 0) known = static_cast<std::int32_t>(t);
      if (joined_.root(static_cast<std::size_t>(known)) != joined_.root(t))
        link(known, static_cast<std::int32_t>(t), 0, 0);
    }
}

/// Numbers 0, 1, ... for the sets in order of their least members.
std::vector<std::int32_t> numbered(DisjointSets& sets, std::size_t count) {
  std::vector<std::int32_t> number(count);
  std::int32_t next = 0;
  for (std::size_t t = 0; t < count; ++t) {
    const std::size_t root = sets.root(t);
    number[t] = root == t ? next++ : number[root];
  }
  return number;
}

}  // namespace

SurfaceGraph surface_graph(const Shape& shape) {
  return GraphBuilder(shape).run();
}

std::vector<std::int32_t> connected_components(const Shape& shape) {
  const std::vector<CornerPlaces> places = places_of(shape);
  DisjointSets sets(places.size());
  std::vector<std::int32_t> first(3 * places.size(), -1);
  for (std::size_t t = 0; t < places.size(); ++t)
    for (const std::int32_t place : places[t]) {
      std::int32_t& known = first[static_cast<std::size_t>(place)];
      if (known < 0) known = static_cast<std::int32_t>(t);
      sets.join(static_cast<std::size_t>(known), t);
    }
  return numbered(sets, places.size());
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
  const std::vector<std::int32_t> shell = connected_components(shape);
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
