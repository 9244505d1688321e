#include "mesh/hull_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "mesh/affine_span.h"
#include "mesh/edge_table.h"
#include "mesh/outer_points.h"
#include "mesh/planar.h"
#include "stackabilization/mesh/convex_hull.h"

namespace stackabilization {

namespace {

bool lexicographically_less(const Points& points, Eigen::Index a, Eigen::Index b) {
  for (int k = 0; k < 3; ++k)
    if (points(a, k) != points(b, k)) return points(a, k) < points(b, k);
  return false;
}

/// The listed rows in lexicographic order, each point once, negative zeros made positive.
Points sorted_rows(const Points& points, std::vector<Eigen::Index> rows) {
  std::sort(rows.begin(), rows.end(), [&](auto a, auto b) { return lexicographically_less(points, a, b); });
  rows.erase(
      std::unique(rows.begin(), rows.end(), [&](auto a, auto b) { return points.row(a) == points.row(b); }),
      rows.end());
  Points result(rows.size(), 3);
  for (std::size_t i = 0; i < rows.size(); ++i) result.row(i) = points.row(rows[i]).array() + 0.0;
  return result;
}

HullFaces straight_hull(const Points& points, const AffineSpan& span) {
  HullFaces hull;
  const Eigen::VectorXd along = points * span.axis;
  Eigen::Index first = 0, last = 0;
  along.minCoeff(&first);
  along.maxCoeff(&last);
  hull.points = sorted_rows(points, {first, last});
  hull.dimension = static_cast<int>(hull.points.rows()) - 1;
  return hull;
}

HullFaces flat_hull(const Points& points, const AffineSpan& span, double resolution) {
  Eigen::Matrix2Xd planar(2, points.rows());
  const Points offsets = points.rowwise() - span.origin.transpose();
  planar.row(0) = (offsets * span.axis).transpose();
  planar.row(1) = (offsets * span.normal.cross(span.axis)).transpose();
  const std::vector<int> polygon = convex_polygon(planar, resolution);
  if (polygon.size() < 3) return straight_hull(points, span);

  const auto size = static_cast<int>(polygon.size());
  std::vector<int> order(polygon);
  std::sort(order.begin(), order.end());
  const auto row = [&](int corner) {
    return static_cast<int>(std::lower_bound(order.begin(), order.end(), polygon[corner]) - order.begin());
  };
  HullFaces hull;
  hull.dimension = 2;
  hull.points = points(order, Eigen::all);
  hull.edges.resize(size, 2);
  hull.edge_faces.resize(size, 2);
  double doubled_area = 0;
  for (int i = 0; i < size; ++i) {
    const int next = (i + 1) % size;
    hull.edges.row(i) << row(i), row(next);
    hull.edge_faces.row(i) << 0, 1;
    const auto a = planar.col(polygon[i]), b = planar.col(polygon[next]);
    doubled_area += a.x() * b.y() - a.y() * b.x();
  }
  hull.normals.resize(2, 3);
  hull.normals << span.normal.transpose(), -span.normal.transpose();
  hull.areas = Eigen::Vector2d::Constant(doubled_area / 2);
  return hull;
}

/// Joins coplanar triangles of a hull to faces, and their common borders to edges. The result does not depend
/// on the triangulation of flat faces, not even by rounding.
class FaceMerger {
 public:
  FaceMerger(const TriangulatedHull& hull, double resolution) : hull_(hull), resolution_(resolution) {
    find_neighbours();
    grow_faces();
    collect_borders();
    if (face_count_ > 1) measure_faces();
  }

  int face_count() const { return face_count_; }
  /// Precondition: there are several faces.
  HullFaces result() const;

 private:
  using Border = std::vector<int>;  ///< rows of the hull points on the common border of two faces

  Eigen::Vector3d corner(int triangle, int k) const {
    return hull_.points.row(hull_.triangles(triangle, k)).transpose();
  }
  Eigen::Vector3d area_vector(int t) const {
    return (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0)) / 2;
  }
  int triangle_count() const { return static_cast<int>(hull_.triangles.rows()); }

  void find_neighbours();
  void grow_faces();
  void grow_face(int seed, int face);
  void collect_borders();
  void measure_faces();
  std::pair<int, int> ends(const Border& border) const;
  std::vector<int> list_faces(HullFaces& faces) const;
  void list_edges(const std::vector<int>& rank, HullFaces& faces) const;

  const TriangulatedHull& hull_;
  double resolution_;
  std::vector<std::array<int, 3>> neighbours_;  ///< triangle across the side from corner k to k + 1
  std::vector<int> face_of_;                    ///< per triangle
  int face_count_ = 0;
  std::vector<Eigen::Vector3d> area_vectors_;  ///< per face
  std::map<std::array<int, 2>, Border> borders_;
};

void FaceMerger::find_neighbours() {
  const detail::EdgeTable edges(hull_.triangles);
  neighbours_.resize(hull_.triangles.rows());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const detail::TriangleSide &a = edges[e].front(), &b = edges[e].back();
    neighbours_[a.triangle][a.corner] = b.triangle;
    neighbours_[b.triangle][b.corner] = a.triangle;
  }
}

void FaceMerger::grow_faces() {
  std::vector<double> areas(hull_.triangles.rows());
  for (int t = 0; t < triangle_count(); ++t) areas[t] = area_vector(t).norm();
  std::vector<int> seeds(areas.size());
  std::iota(seeds.begin(), seeds.end(), 0);
  std::stable_sort(seeds.begin(), seeds.end(), [&](int a, int b) { return areas[a] > areas[b]; });
  face_of_.assign(areas.size(), -1);
  for (const int seed : seeds)
    if (face_of_[seed] < 0) grow_face(seed, face_count_++);
}

/// Updates the plane with every triangle, so that a face of many small triangles is as flat as its whole
/// extent allows.
void FaceMerger::grow_face(int seed, int face) {
  const Eigen::Vector3d origin = corner(seed, 0);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::vector<int> waiting = {seed};
  face_of_[seed] = face;
  for (std::size_t next = 0; next < waiting.size(); ++next) {
    sum += area_vector(waiting[next]);
    const Eigen::Vector3d normal = sum.normalized();
    for (const int neighbour : neighbours_[waiting[next]]) {
      if (face_of_[neighbour] >= 0) continue;
      double distance = 0;
      for (int k = 0; k < 3; ++k)
        distance = std::max(distance, std::abs(normal.dot(corner(neighbour, k) - origin)));
      if (distance > resolution_) continue;
      face_of_[neighbour] = face;
      waiting.push_back(neighbour);
    }
  }
}

void FaceMerger::collect_borders() {
  for (int t = 0; t < triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int here = face_of_[t];
      const int there = face_of_[neighbours_[t][k]];
      if (here >= there) continue;
      Border& border = borders_[{here, there}];
      border.push_back(hull_.triangles(t, k));
      border.push_back(hull_.triangles(t, (k + 1) % 3));
    }
}

/// Area vectors from the borders, whose sides are added in the order of their corners.
void FaceMerger::measure_faces() {
  std::vector<std::vector<std::array<int, 2>>> sides(static_cast<std::size_t>(face_count_));
  for (int t = 0; t < triangle_count(); ++t)
    for (int k = 0; k < 3; ++k)
      if (face_of_[neighbours_[t][k]] != face_of_[t])
        sides[face_of_[t]].push_back({hull_.triangles(t, k), hull_.triangles(t, (k + 1) % 3)});
  const auto point = [&](int row) -> Eigen::Vector3d { return hull_.points.row(row).transpose(); };
  for (auto& border : sides) {
    std::sort(border.begin(), border.end());
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const Eigen::Vector3d origin = point(border.front()[0]);
    for (const auto& [from, to] : border) sum += (point(from) - origin).cross(point(to) - origin);
    area_vectors_.push_back(sum / 2);
  }
}

/// Two faces of a convex hull meet along one straight edge: its ends are the points farthest along it.
std::pair<int, int> FaceMerger::ends(const Border& border) const {
  const auto point = [&](int row) -> Eigen::Vector3d { return hull_.points.row(row).transpose(); };
  const auto farthest_from = [&](int row) {
    return *std::max_element(border.begin(), border.end(), [&](int a, int b) {
      return (point(a) - point(row)).squaredNorm() < (point(b) - point(row)).squaredNorm();
    });
  };
  const int first = farthest_from(border.front());
  return std::minmax({first, farthest_from(first)});
}

HullFaces FaceMerger::result() const {
  HullFaces faces;
  faces.dimension = 3;
  list_edges(list_faces(faces), faces);
  return faces;
}

/// Fills in normals and areas, largest first; returns the place of each grown face among them.
std::vector<int> FaceMerger::list_faces(HullFaces& faces) const {
  std::vector<int> order(area_vectors_.size()), rank(area_vectors_.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const Eigen::Vector3d &p = area_vectors_[a], &q = area_vectors_[b];
    return std::tuple(-p.norm(), p.x(), p.y(), p.z()) < std::tuple(-q.norm(), q.x(), q.y(), q.z());
  });
  faces.normals.resize(static_cast<Eigen::Index>(order.size()), 3);
  faces.areas.resize(static_cast<Eigen::Index>(order.size()));
  for (std::size_t i = 0; i < order.size(); ++i) {
    rank[order[i]] = static_cast<int>(i);
    faces.areas(i) = area_vectors_[order[i]].norm();
    faces.normals.row(i) = area_vectors_[order[i]].normalized().transpose();
  }
  return rank;
}

/// Fills in the edges, in the order of their ends, and the points there.
void FaceMerger::list_edges(const std::vector<int>& rank, HullFaces& faces) const {
  std::vector<int> row(hull_.points.rows(), -1);
  faces.edges.resize(static_cast<Eigen::Index>(borders_.size()), 2);
  faces.edge_faces.resize(static_cast<Eigen::Index>(borders_.size()), 2);
  std::vector<std::array<int, 4>> edges;
  for (const auto& [pair, border] : borders_) {
    const auto [a, b] = ends(border);
    const auto [left, right] = std::minmax({rank[pair[0]], rank[pair[1]]});
    edges.push_back({a, b, left, right});
    row[a] = row[b] = 0;
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    faces.edges.row(static_cast<Eigen::Index>(e)) << edges[e][0], edges[e][1];
    faces.edge_faces.row(static_cast<Eigen::Index>(e)) << edges[e][2], edges[e][3];
  }
  std::vector<int> kept;
  for (int i = 0; i < static_cast<int>(row.size()); ++i)
    if (row[i] == 0) {
      row[i] = static_cast<int>(kept.size());
      kept.push_back(i);
    }
  faces.points = hull_.points(kept, Eigen::all);
  faces.edges = faces.edges.unaryExpr([&](int i) { return row[i]; }).eval();
}

/// When faces of a body hardly thicker than the resolution merge, the remaining corners may lie in a plane.
/// The body is then flat.
HullFaces solid_hull(const Points& points, const AffineSpan& span, double resolution) {
  const TriangulatedHull hull = triangulated_hull(points);
  const FaceMerger merger(hull, resolution);
  if (merger.face_count() < 4) return flat_hull(points, span, resolution);
  HullFaces faces = merger.result();
  if (affine_span(faces.points, resolution).dimension < 3) return flat_hull(points, span, resolution);
  return faces;
}

HullFaces hull_of_distinct(const Points& points, double resolution) {
  const AffineSpan span = affine_span(points, resolution);
  if (span.dimension == 3) return solid_hull(points, span, resolution);
  if (span.dimension == 2) return flat_hull(points, span, resolution);
  if (span.dimension == 1) return straight_hull(points, span);
  HullFaces single;
  single.points = points.topRows(1);
  return single;
}

}  // namespace

HullFaces hull_faces(const Points& points, double resolution) {
  const int exponent = working_exponent(points);
  const Points scaled = scaled_by_power(points, exponent);
  const Points distinct = sorted_rows(scaled, outer_points(scaled));
  HullFaces hull = hull_of_distinct(distinct, std::ldexp(resolution, exponent));
  if (exponent == 0) return hull;
  hull.points = scaled_by_power(hull.points, -exponent);
  hull.areas = hull.areas.unaryExpr([exponent](double a) { return std::ldexp(a, -2 * exponent); }).eval();
  return hull;
}

}  // namespace stackabilization
