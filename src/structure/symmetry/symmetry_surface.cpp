#include "structure/symmetry/symmetry_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "mesh/surface_moments.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {

namespace {

constexpr int sparse_samples = 150, medium_samples = 500, max_corners = 300;
constexpr double slender_extents = 3;

struct OwnFrame {
  Shape shape;
  Eigen::Vector3d centroid;
  double diagonal;
  OrientedBox box;
  double area = 0;                                       ///< of `shape`
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the surface of `shape`
};

OwnFrame own_frame(const Shape& shape) {
  OwnFrame frame{shape, {}, 0, minimal_oriented_box(HullSupport(shape))};
  frame.diagonal = 2 * frame.box.half_extents.norm();
  const Eigen::Vector3d centre = frame.box.centre;
  frame.shape.vertices = (shape.vertices.rowwise() - centre.transpose()) / frame.diagonal;
  const SurfaceMoments moments(frame.shape, Eigen::Vector3d::Zero());
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  frame.area = moments.area();
  if (frame.area > 0) {
    offset = moments.centre();
    frame.covariance = moments.covariance();
  }
  frame.shape.vertices.rowwise() -= offset.transpose();
  frame.centroid = centre + frame.diagonal * offset;
  frame.box.centre = -offset;
  frame.box.half_extents /= frame.diagonal;
  return frame;
}

Points used_corners(const Shape& shape) {
  std::vector<char> used(static_cast<std::size_t>(shape.vertex_count()), 0);
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    for (int corner = 0; corner < 3; ++corner) used[static_cast<std::size_t>(shape.triangles(t, corner))] = 1;
  std::vector<Eigen::Index> rows;
  for (std::size_t v = 0; v < used.size(); ++v)
    if (used[v]) rows.push_back(static_cast<Eigen::Index>(v));
  const std::size_t count = std::min<std::size_t>(rows.size(), max_corners);
  Points corners(static_cast<Eigen::Index>(count), 3);
  for (std::size_t k = 0; k < count; ++k)
    corners.row(static_cast<Eigen::Index>(k)) = shape.vertices.row(rows[k * rows.size() / count]);
  return corners;
}

Points unit_normals(const Shape& shape) {
  Points normals(shape.triangle_count(), 3);
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    normals.row(t) = unit_normal(shape, t).transpose();
  return normals;
}

double middle(Eigen::Vector3d values) {
  std::sort(values.begin(), values.end());
  return values(1);
}

}  // namespace

SymmetrySurface symmetry_surface(const Shape& shape, int samples) {
  const OwnFrame frame = own_frame(shape);
  return {.centroid = frame.centroid,
          .diagonal = frame.diagonal,
          .box = frame.box,
          .spread = frame.covariance,
          .area = frame.area * frame.diagonal * frame.diagonal,
          .scale = std::clamp(slender_extents * 2 * middle(frame.box.half_extents), tolerance::relative, 1.0),
          .index = SurfaceIndex(frame.shape),
          .normals = unit_normals(frame.shape),
          .dense = surface_samples(frame.shape, samples),
          .medium = surface_samples(frame.shape, medium_samples),
          .sparse = surface_samples(frame.shape, sparse_samples),
          .corners = used_corners(frame.shape)};
}

Symmetry to_model(const SymmetrySurface& surface, const Symmetry& own) {
  Symmetry model = own;
  model.point = surface.centroid + surface.diagonal * own.point;
  return model;
}

Symmetry to_own(const SymmetrySurface& surface, const Symmetry& model) {
  Symmetry own = model;
  own.point = (model.point - surface.centroid) / surface.diagonal;
  own.point = foot(own);
  return own;
}

Eigen::Vector3d foot(const Symmetry& symmetry) {
  const Eigen::Vector3d along = symmetry.axis * symmetry.axis.dot(symmetry.point);
  return symmetry.kind == SymmetryKind::reflection ? along : Eigen::Vector3d(symmetry.point - along);
}

}  // namespace stackabilization::detail
