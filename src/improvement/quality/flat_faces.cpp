#include "improvement/quality/flat_faces.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "core/angles.h"
#include "core/index.h"
#include "mesh/edge_table.h"
#include "mesh/surface_moments.h"
#include "stackabilization/improvement/tolerances.h"

namespace stackabilization::detail {

namespace {

/// Largest number of faces of a part that are looked at.
constexpr std::size_t max_faces = 64;
/// Largest distance of faces in one plane, fraction of the square root of the smaller area.
constexpr double near_plane = 0.1;
/// Least share of the probes of a face whose other end is on the face opposite, where both are the sides of a
/// wall: most of them. The floor and two other walls of a crate are between its opposite walls, too.
constexpr double wall_share = 0.5;

/// Neighbours across edges, for some triangles of a mesh.
class EdgeNeighbours {
 public:
  EdgeNeighbours(const WeldedMesh& mesh, const std::vector<std::int32_t>& triangles) {
    Triangles rows(static_cast<Eigen::Index>(triangles.size()), 3);
    for (std::size_t k = 0; k < triangles.size(); ++k)
      rows.row(static_cast<Eigen::Index>(k)) = mesh.triangles.row(triangles[k]);
    neighbours_.resize(triangles.size());
    const EdgeTable edges(rows);
    for (std::size_t edge = 0; edge < edges.size(); ++edge)
      for (const TriangleSide& a : edges[edge])
        for (const TriangleSide& b : edges[edge])
          if (a.triangle != b.triangle) neighbours_[at(a.triangle)].push_back(b.triangle);
  }
  const std::vector<std::int32_t>& of(std::size_t triangle) const { return neighbours_[triangle]; }

 private:
  std::vector<std::vector<std::int32_t>> neighbours_;
};

FlatFace face_of(const Shape& shape, const std::vector<std::int32_t>& triangles,
                 const std::vector<std::size_t>& rows) {
  FlatFace face;
  for (const std::size_t row : rows) face.triangles.push_back(triangles[row]);
  std::sort(face.triangles.begin(), face.triangles.end());
  const Eigen::Vector3d front = detail::area_vector(shape, face.triangles.front());
  for (const std::int32_t t : face.triangles) {
    face.area += detail::area_vector(shape, t).norm();
    face.sides.push_back(detail::area_vector(shape, t).dot(front) < 0 ? -1 : 1);
    for (int k = 0; k < 3; ++k) face.vertices.push_back(shape.triangles(t, k));
  }
  std::sort(face.vertices.begin(), face.vertices.end());
  face.vertices.erase(std::unique(face.vertices.begin(), face.vertices.end()), face.vertices.end());
  face.deviation = face.deviation_on(shape);
  Eigen::AlignedBox3d box;
  for (const Eigen::Index v : face.vertices) box.extend(shape.vertices.row(v).transpose());
  face.width = face.area / box.diagonal().norm();
  return face;
}

/// Returns whether two parallel faces lie in one plane, or nearly for their size.
bool in_one_plane(const Shape& shape, const FlatFace& one, const FlatFace& other) {
  const Eigen::RowVector3d between = shape.vertices(other.vertices, Eigen::all).colwise().mean() -
                                     shape.vertices(one.vertices, Eigen::all).colwise().mean();
  return std::abs(one.area_vector(shape).stableNormalized().dot(between)) <=
         near_plane * std::sqrt(std::min(one.area, other.area));
}

}  // namespace

Eigen::Vector3d FlatFace::area_vector(const Shape& shape) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < triangles.size(); ++k)
    sum += sides[k] * detail::area_vector(shape, triangles[k]);
  return sum;
}

double FlatFace::deviation_on(const Shape& shape) const {
  Eigen::RowVector3d centre = Eigen::RowVector3d::Zero();
  for (const Eigen::Index v : vertices) centre += shape.vertices.row(v);
  centre /= static_cast<double>(vertices.size());
  const Eigen::RowVector3d normal = area_vector(shape).stableNormalized().transpose();
  double farthest = 0;
  for (const Eigen::Index v : vertices)
    farthest = std::max(farthest, std::abs(normal.dot(shape.vertices.row(v) - centre)));
  return farthest;
}

std::vector<FlatFace> flat_faces(const Shape& shape, const WeldedMesh& mesh,
                                 const std::vector<std::int32_t>& triangles, double min_share) {
  std::vector<Eigen::Vector3d> normals;
  double area = 0;
  for (const std::int32_t t : triangles) {
    normals.push_back(unit_normal(shape, t));
    area += area_vector(shape, t).norm();
  }
  const EdgeNeighbours neighbours(mesh, triangles);
  const double cosine = std::cos(tolerance::quality::coplanar);
  std::vector<char> taken(triangles.size(), 0);
  std::vector<FlatFace> faces;
  for (std::size_t seed = 0; seed < triangles.size(); ++seed) {
    if (taken[seed] || normals[seed].isZero()) continue;
    std::vector<std::size_t> rows{seed};
    taken[seed] = 1;
    for (std::size_t k = 0; k < rows.size(); ++k)
      for (const std::int32_t next : neighbours.of(rows[k])) {
        // The orientation of the triangles may differ.
        if (taken[at(next)] || std::abs(normals[at(next)].dot(normals[seed])) < cosine) continue;
        taken[at(next)] = 1;
        rows.push_back(at(next));
      }
    double share = 0;
    for (const std::size_t row : rows) share += area_vector(shape, triangles[row]).norm();
    if (share >= min_share * area && share > 0) faces.push_back(face_of(shape, triangles, rows));
  }
  std::stable_sort(faces.begin(), faces.end(),
                   [](const FlatFace& a, const FlatFace& b) { return a.area > b.area; });
  if (faces.size() > max_faces) faces.resize(max_faces);
  return faces;
}

std::vector<ParallelFaces> parallel_faces(const Shape& shape, const std::vector<FlatFace>& faces) {
  std::vector<ParallelFaces> pairs;
  for (std::size_t a = 0; a < faces.size(); ++a)
    for (std::size_t b = a + 1; b < faces.size(); ++b) {
      const double angle = angle_between_lines(faces[a].area_vector(shape), faces[b].area_vector(shape));
      if (angle <= tolerance::quality::coplanar) pairs.push_back({a, b, angle});
    }
  return pairs;
}

void remove_pairs_across_air(const Shape& shape, const std::vector<FlatFace>& faces,
                             const std::vector<ThicknessProbe>& probes, std::vector<ParallelFaces>& pairs) {
  if (pairs.empty()) return;
  std::map<std::int32_t, std::size_t> face_of;
  for (std::size_t face = 0; face < faces.size(); ++face)
    for (const std::int32_t t : faces[face].triangles) face_of[t] = face;
  std::vector<double> probed(faces.size());
  std::map<std::pair<std::size_t, std::size_t>, double> shared;
  for (const ThicknessProbe& probe : probes) {
    const auto near = face_of.find(probe.near_triangle), far = face_of.find(probe.far_triangle);
    if (near != face_of.end()) ++probed[near->second];
    if (far != face_of.end()) ++probed[far->second];
    if (near == face_of.end() || far == face_of.end()) continue;
    ++shared[std::minmax(near->second, far->second)];
  }
  std::erase_if(pairs, [&](const ParallelFaces& pair) {
    const double fewer = std::min(probed[pair.first], probed[pair.second]);
    return fewer > 0 && shared[{pair.first, pair.second}] < wall_share * fewer &&
           !in_one_plane(shape, faces[pair.first], faces[pair.second]);
  });
}

}  // namespace stackabilization::detail
