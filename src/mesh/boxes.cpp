#include "stackabilization/mesh/boxes.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "mesh/affine_span.h"
#include "mesh/hull_faces.h"
#include "mesh/planar.h"
#include "mesh/tolerances.h"
#include "mesh/used_vertices.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization {

namespace {

void require_finite(const Points& points) {
  if (points.rows() == 0) throw InputError("a box needs at least one point");
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    if (!points.row(i).allFinite())
      throw InputError("point " + std::to_string(i) + " has a coordinate that is not a finite number");
}

/// The smallest box with the given axes around points.
OrientedBox box_with_axes(const Points& points, const Eigen::Matrix3d& axes) {
  const Eigen::Vector3d centre = (points.colwise().minCoeff() + points.colwise().maxCoeff()).transpose() / 2;
  const Points local = (points.rowwise() - centre.transpose()) * axes;
  const Eigen::Vector3d low = local.colwise().minCoeff().transpose(),
                        high = local.colwise().maxCoeff().transpose();
  return {centre + axes * ((low + high) / 2), axes, (high - low) / 2};
}

}  // namespace

HullSupport::HullSupport(const Shape& shape) : HullSupport(used_vertices(shape)) {}

HullSupport::HullSupport(const Points& points) {
  require_finite(points);
  resolution_ = tolerance::rounding * points.cwiseAbs().maxCoeff();
  HullFaces faces = hull_faces(points, resolution_);
  dimension_ = faces.dimension;
  points_ = std::move(faces.points);
  face_normals_ = std::move(faces.normals);
  face_areas_ = std::move(faces.areas);
  edges_ = std::move(faces.edges);
  edge_faces_ = std::move(faces.edge_faces);
  centre_ = (points_.colwise().minCoeff() + points_.colwise().maxCoeff()).transpose() / 2;
  centred_points_ = points_.rowwise() - centre_.transpose();
  normal_columns_ = face_normals_;
  // All corners count where normals do not tell the silhouette.
  if (affine_span(points_, tolerance::hull_silhouette * points.cwiseAbs().maxCoeff()).dimension < dimension_)
    normal_columns_.setZero();
}

double HullSupport::extent(const Direction& direction) const {
  const Eigen::VectorXd heights = centred_points_ * direction.unit();
  return heights.maxCoeff() - heights.minCoeff();
}

Eigen::Matrix2Xd HullSupport::projection(const Frame& frame) const {
  // Bytes: all faces of a large hull stay in the processor's nearest cache.
  const Eigen::Array<bool, Eigen::Dynamic, 1> faces = (normal_columns_ * frame.w).array() > 0;
  std::vector<int> rows;
  std::vector<char> listed(points_.rows(), 0);
  for (Eigen::Index e = 0; e < edges_.rows(); ++e) {
    if (faces[edge_faces_(e, 0)] == faces[edge_faces_(e, 1)]) continue;
    for (int end = 0; end < 2; ++end)
      if (!std::exchange(listed[edges_(e, end)], 1)) rows.push_back(edges_(e, end));
  }
  Eigen::Matrix2Xd projected;
  if (rows.empty()) {  // a flat set seen edge on, one that is nearly flat, a straight one or a point
    projected.resize(2, points_.rows());
    projected.row(0) = (centred_points_ * frame.u).transpose();
    projected.row(1) = (centred_points_ * frame.v).transpose();
  } else {
    projected.resize(2, static_cast<Eigen::Index>(rows.size()));
    for (Eigen::Index i = 0; i < projected.cols(); ++i) {
      const Eigen::Vector3d p = centred_points_.row(rows[i]).transpose();
      projected.col(i) << p.dot(frame.u), p.dot(frame.v);
    }
  }
  return projected(Eigen::all, convex_polygon(projected, resolution_));
}

double HullSupport::minimal_rectangle_area(const Direction& direction) const {
  return minimal_rectangle(projection(frame_of(direction))).area();
}

OrientedBox HullSupport::box_along(const Direction& direction) const {
  const Frame frame = frame_of(direction);
  const PlanarRectangle rectangle = minimal_rectangle(projection(frame));
  const Eigen::VectorXd heights = centred_points_ * frame.w;
  const double low = heights.minCoeff(), high = heights.maxCoeff();

  OrientedBox box;
  box.axes.col(0) = frame.u * rectangle.axis.x() + frame.v * rectangle.axis.y();
  box.axes.col(1) = frame.v * rectangle.axis.x() - frame.u * rectangle.axis.y();
  box.axes.col(2) = frame.w;
  box.half_extents << rectangle.size / 2, (high - low) / 2;
  box.centre = centre_ + frame.to_world({rectangle.centre.x(), rectangle.centre.y(), (low + high) / 2});
  return box;
}

OrientedBox axis_aligned_box(const Points& points) {
  require_finite(points);
  return box_with_axes(points, Eigen::Matrix3d::Identity());
}

OrientedBox frame_box(const Points& points, const Direction& direction) {
  require_finite(points);
  const Frame frame = frame_of(direction);
  Eigen::Matrix3d axes;
  axes << frame.u, frame.v, frame.w;
  return box_with_axes(points, axes);
}

}  // namespace stackabilization
