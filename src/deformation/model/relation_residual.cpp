#include "stackabilization/deformation/relation_residual.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>

#include "core/index.h"
#include "deformation/model/joint_slides.h"
#include "deformation/model/transfer.h"
#include "mesh/barycentric.h"
#include "mesh/surface_index.h"
#include "stackabilization/core/errors.h"
#include "structure/model/correspondence.h"

namespace stackabilization {

namespace {

using detail::at;
using detail::barycentric_weights;

/// Like std::max, but keeps a distance that is not a number.
void widen(double& gap, double distance) {
  if (!std::isnan(gap) && !(distance <= gap)) gap = distance;
}

double symmetry_gap(const Relation& relation, const Structure& rest, const std::vector<Primitive>& deformed) {
  const auto a = static_cast<std::size_t>(relation.parts.front());
  const auto b = static_cast<std::size_t>(relation.parts.back());
  const Eigen::Isometry3d map = isometry_of(relation.symmetry);
  const std::vector<int> order =
      control_correspondence(rest.parts[a].primitive, rest.parts[b].primitive, map);
  if (order.empty())
    throw InputError("the primitives of '" + rest.parts[a].name + "' and '" + rest.parts[b].name +
                     "' cannot be symmetric: they differ in kind or in their number of cross-sections");
  const Points from = control_points(deformed[a]), to = control_points(deformed[b]);
  double gap = 0;
  for (Eigen::Index i = 0; i < from.rows(); ++i) {
    const Eigen::Vector3d image = map * from.row(i).transpose();
    widen(gap, (image - to.row(order[static_cast<std::size_t>(i)]).transpose()).norm());
  }
  if (const auto* cylinder = std::get_if<GeneralizedCylinder>(&deformed[a])) {
    const Eigen::VectorXd& radii = std::get<GeneralizedCylinder>(deformed[b]).radii;
    for (Eigen::Index i = 0; i < from.rows(); ++i)
      widen(gap, std::abs(cylinder->radii(i) - radii(order[static_cast<std::size_t>(i)])));
  }
  return gap;
}

double joint_gap(const Relation& relation, const Structure& rest, const std::vector<Primitive>& deformed) {
  const auto beyond_slack = [&](double distance) {
    return distance <= relation.slack ? 0 : distance - relation.slack;
  };
  double gap = 0;
  for (Eigen::Index i = 0; i < relation.points.rows(); ++i) {
    const auto place = [&](int part) {
      const auto k = static_cast<std::size_t>(part);
      return deform_point(rest.parts[k].primitive, deformed[k], relation.points.row(i).transpose());
    };
    const Eigen::Vector3d first = place(relation.parts[0]), second = place(relation.parts[1]);
    if (!relation.slides(i)) {
      widen(gap, beyond_slack((first - second).norm()));
      continue;
    }
    const Primitive& carrier = deformed[static_cast<std::size_t>(relation.carrier)];
    const bool on_first = relation.carrier == relation.parts[0];
    const std::array<bool, 3>& ways = relation.sliding[static_cast<std::size_t>(i)];
    const Eigen::Matrix3d held = detail::held_directions(carrier, on_first ? first : second, ways);
    widen(gap, beyond_slack((held * (first - second)).norm()));
    widen(gap, detail::distance_beyond(carrier, on_first ? second : first, ways));
  }
  return gap;
}

/// Distances at rest, from gaps and irregular meshes, stretch with their parts: they may grow to this many
/// times their size.
constexpr double stretched_gap = 2;
/// Largest number of projections from one surface to the other on the way to the place where they meet.
constexpr int max_projections = 200;

/// A point of a mesh.
struct MeshPoint {
  Eigen::RowVector3i corners;
  Eigen::RowVector3d weights;

  Eigen::Vector3d in(const Shape& shape) const {
    Eigen::RowVector3d point = Eigen::RowVector3d::Zero();
    for (int k = 0; k < 3; ++k) point += weights(k) * shape.vertices.row(corners(k));
    return point.transpose();
  }
};

/// Surface of one part at rest.
class PartMesh {
 public:
  PartMesh(const Shape& shape, int part) : surface_(extract_part(shape, part)), index_(surface_) {
    std::set<std::int32_t> used;
    for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
      if (shape.triangle_part[static_cast<std::size_t>(t)] == part)
        for (int k = 0; k < 3; ++k) used.insert(shape.triangles(t, k));
    vertices_.assign(used.begin(), used.end());
  }

  SurfacePoint nearest(const Eigen::Vector3d& point) const { return index_.nearest(point); }
  MeshPoint bound(const SurfacePoint& point) const {
    MeshPoint result;
    result.weights = barycentric_weights(surface_, point.triangle, point.point).transpose();
    for (int k = 0; k < 3; ++k) result.corners(k) = vertices_[at(surface_.triangles(point.triangle, k))];
    return result;
  }
  /// Returns the vertices of the part, rows of the whole shape, ascending.
  const std::vector<std::int32_t>& vertices() const { return vertices_; }

 private:
  Shape surface_;  ///< its vertices are those of `vertices()`
  SurfaceIndex index_;
  std::vector<std::int32_t> vertices_;
};

/// Measures relations on a deformed mesh.
class MeshRelations {
 public:
  MeshRelations(const StructuredShape& rest, const Shape& deformed)
      : rest_(rest.shape), deformed_(deformed), meshes_(rest.structure.parts.size()) {}

  /// Returns the distance by which a relation is off, model units.
  double gap(const Relation& relation) {
    const int a = relation.parts.front(), b = relation.parts.back();
    double gap = 0;
    if (relation.is_joint()) {
      for (Eigen::Index i = 0; i < relation.points.rows(); ++i)
        widen(gap, opening(a, b, relation.points.row(i).transpose()));
      return gap;
    }
    const Eigen::Isometry3d map = isometry_of(relation.symmetry);
    widen(gap, asymmetry(a, b, map));
    if (a != b) widen(gap, asymmetry(b, a, map.inverse()));
    return gap;
  }

 private:
  const PartMesh& mesh(int part) {
    std::optional<PartMesh>& mesh = meshes_[at(part)];
    if (!mesh) mesh.emplace(rest_, part);
    return *mesh;
  }

  /// Returns how far two places that were `before` apart have come apart.
  static double excess(const Eigen::Vector3d& before, const Eigen::Vector3d& now) {
    const double beyond = now.norm() - stretched_gap * before.norm();
    return beyond < 0 ? 0 : beyond;
  }

  /// Returns how far the images of the vertices of part `from` miss the points of part `to` that were nearest
  /// to them at rest.
  double asymmetry(int from, int to, const Eigen::Isometry3d& map) {
    double gap = 0;
    for (const std::int32_t v : mesh(from).vertices()) {
      const Eigen::Vector3d before = map * Eigen::Vector3d(rest_.vertices.row(v)),
                            now = map * Eigen::Vector3d(deformed_.vertices.row(v));
      const MeshPoint other = mesh(to).bound(mesh(to).nearest(before));
      widen(gap, excess(other.in(rest_)-before, other.in(deformed_)-now));
    }
    return gap;
  }

  /// Returns how far two parts have come apart where they met next to `joint` at rest. Projections from one
  /// surface to the other lead there.
  double opening(int a, int b, const Eigen::Vector3d& joint) {
    const PartMesh &one = mesh(a), &other = mesh(b);
    SurfacePoint on_one = one.nearest(joint), on_other = other.nearest(on_one.point);
    for (int k = 0; k < max_projections && on_other.distance > 0; ++k) {
      const SurfacePoint next = one.nearest(on_other.point), opposite = other.nearest(next.point);
      if (!(opposite.distance < on_other.distance)) break;
      on_one = next;
      on_other = opposite;
    }
    const MeshPoint from = one.bound(on_one), to = other.bound(on_other);
    return excess(to.in(rest_)-from.in(rest_), to.in(deformed_)-from.in(deformed_));
  }

  const Shape& rest_;
  const Shape& deformed_;
  std::vector<std::optional<PartMesh>> meshes_;
};

}  // namespace

std::vector<double> relation_residuals(const Structure& rest, const std::vector<Primitive>& deformed) {
  std::vector<double> residuals;
  for (const Relation& relation : rest.relations) {
    const double gap =
        relation.is_joint() ? joint_gap(relation, rest, deformed) : symmetry_gap(relation, rest, deformed);
    residuals.push_back(gap / rest.diagonal);
  }
  return residuals;
}

std::vector<double> mesh_relation_residuals(const StructuredShape& rest, const Shape& deformed) {
  MeshRelations relations(rest, deformed);
  std::vector<double> residuals;
  for (const Relation& relation : rest.structure.relations)
    residuals.push_back(relations.gap(relation) / rest.structure.diagonal);
  return residuals;
}

}  // namespace stackabilization
