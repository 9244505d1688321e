#include "stackabilization/mesh/boxes.h"

#include <algorithm>
#include <array>
#include <numeric>
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

/// The edges of an outline, put one after the other.
class OutlineWalk {
 public:
  explicit OutlineWalk(Eigen::Index corners) : neighbours_(static_cast<std::size_t>(corners), {-1, -1}) {}

  void add(int a, int b) {
    add_neighbour(a, b);
    add_neighbour(b, a);
  }
  /// Returns the corners of all edges: one way round where the edges are one closed curve.
  std::vector<int> corners() {
    std::vector<int> way;
    if (corners_.empty()) return way;
    way.reserve(corners_.size());
    closed_ = !crowded_;
    int before = -1, now = corners_.front();
    while (closed_) {
      way.push_back(now);
      const auto& [a, b] = neighbours_[static_cast<std::size_t>(now)];
      const int next = a == before ? b : a;
      before = std::exchange(now, next);
      if (now < 0 || way.size() > corners_.size()) closed_ = false;
      if (now == corners_.front()) break;
    }
    closed_ = closed_ && way.size() == corners_.size() && way.size() > 2;
    return closed_ ? way : corners_;
  }
  /// Returns whether `corners()` found one closed curve.
  bool is_closed() const { return closed_; }

 private:
  void add_neighbour(int corner, int other) {
    std::array<int, 2>& entry = neighbours_[static_cast<std::size_t>(corner)];
    if (entry[0] < 0) {
      entry[0] = other;
      corners_.push_back(corner);
    } else if (entry[1] < 0) {
      entry[1] = other;
    } else {
      crowded_ = true;
    }
  }

  std::vector<std::array<int, 2>> neighbours_;
  std::vector<int> corners_;  ///< in the order in which they were first met
  bool crowded_ = false, closed_ = false;
};

/// Puts a closed curve and its rows counter-clockwise from the lexicographically smallest corner, as
/// convex_polygon does. Returns whether it is a convex polygon with distinct corners, none of which is
/// straight.
bool order_as_polygon(Eigen::Matrix2Xd& curve, double resolution, std::vector<int>& rows) {
  const Eigen::Index m = curve.cols();
  double area = 0;
  for (Eigen::Index i = 1; i + 1 < m; ++i)
    area += cross(curve.col(i) - curve.col(0), curve.col(i + 1) - curve.col(0));
  if (area < 0) {
    curve = curve.rowwise().reverse().eval();
    std::reverse(rows.begin(), rows.end());
  }
  Eigen::Index first = 0;
  for (Eigen::Index i = 1; i < m; ++i)
    if (std::make_pair(curve(0, i), curve(1, i)) < std::make_pair(curve(0, first), curve(1, first)))
      first = i;
  std::rotate(rows.begin(), rows.begin() + first, rows.end());
  curve = (Eigen::Matrix2Xd(2, m) << curve.rightCols(m - first), curve.leftCols(first)).finished();
  int rounds = 0;  // half planes that sides enter: two on one way round
  Eigen::Vector2d before = curve.col(0) - curve.col(m - 1);
  for (Eigen::Index i = 0; i < m; ++i) {
    const Eigen::Vector2d side = curve.col(i + 1 < m ? i + 1 : 0) - curve.col(i);
    if (side.norm() <= resolution || !(cross(before, side) > 0)) return false;
    rounds += (side.x() > 0) != (before.x() > 0);
    before = side;
  }
  return rounds == 2;
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
  const Eigen::VectorXd heights = heights_along(direction.unit());
  return heights.maxCoeff() - heights.minCoeff();
}

Silhouette HullSupport::silhouette(const Frame& frame) const {
  // Bytes: all faces of a large hull stay in the processor's nearest cache.
  const Eigen::Array<bool, Eigen::Dynamic, 1> faces = (normal_columns_ * frame.w).array() > 0;
  OutlineWalk walk(points_.rows());
  for (Eigen::Index e = 0; e < edges_.rows(); ++e)
    if (faces[edge_faces_(e, 0)] != faces[edge_faces_(e, 1)]) walk.add(edges_(e, 0), edges_(e, 1));
  std::vector<int> rows = walk.corners();
  if (rows.empty()) {  // a flat set seen edge on, one that is nearly flat, a straight one or a point
    rows.resize(static_cast<std::size_t>(points_.rows()));
    std::iota(rows.begin(), rows.end(), 0);
  }
  Eigen::Matrix2Xd projected(2, static_cast<Eigen::Index>(rows.size()));
  for (Eigen::Index i = 0; i < projected.cols(); ++i) {
    const Eigen::Vector3d p = centred_points_.row(rows[static_cast<std::size_t>(i)]).transpose();
    projected.col(i) << p.dot(frame.u), p.dot(frame.v);
  }
  if (walk.is_closed() && order_as_polygon(projected, resolution_, rows)) return {rows, projected};
  const std::vector<int> columns = convex_polygon(projected, resolution_);
  Silhouette result{{}, projected(Eigen::all, columns)};
  for (const int column : columns) result.corners.push_back(rows[static_cast<std::size_t>(column)]);
  return result;
}

double HullSupport::minimal_rectangle_area(const Direction& direction) const {
  return minimal_rectangle(silhouette(frame_of(direction)).polygon).area();
}

OrientedBox HullSupport::box_along(const Direction& direction) const {
  const Frame frame = frame_of(direction);
  const PlanarRectangle rectangle = minimal_rectangle(silhouette(frame).polygon);
  const Eigen::VectorXd heights = heights_along(frame.w);
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
