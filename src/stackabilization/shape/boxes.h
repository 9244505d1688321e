#pragma once

#include <Eigen/Core>
#include <array>

#include "stackabilization/shape/direction.h"
#include "stackabilization/shape/shape.h"

namespace stackabilization {

/// A box: centre, right-handed orthonormal axes (columns), half extents along them, model units.
struct OrientedBox {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Eigen::Vector3d half_extents = Eigen::Vector3d::Zero();

  double volume() const { return 8 * half_extents.prod(); }
};

/// Convex hull prepared for box and extent queries in many directions; one per shape, safe to share between threads.
class HullSupport {
 public:
  /// Hull of the vertices that triangles use. Flat, straight and single-point sets are accepted.
  explicit HullSupport(const Shape& shape);
  explicit HullSupport(const Points& points);

  /// k x 3 extreme points in a deterministic order.
  const Points& points() const { return points_; }
  /// f x 3 unit outward normals of the hull faces (coplanar triangles merged), largest face first; for a flat set the
  /// two normals of its plane; empty for straight and single-point sets.
  const Points& face_normals() const { return face_normals_; }
  /// f areas of those faces, model units squared.
  const Eigen::VectorXd& face_areas() const { return face_areas_; }
  /// e x 2 rows of `points()`: hull edges between faces that are not coplanar, with e x 2 adjacent faces.
  const Eigen::Matrix<int, Eigen::Dynamic, 2>& edges() const { return edges_; }
  const Eigen::Matrix<int, Eigen::Dynamic, 2>& edge_faces() const { return edge_faces_; }

  /// h(M, r): extent along r / |r|, model units.
  double extent(const Direction& direction) const;
  /// Area of the minimal-area rectangle that holds the projection along r. Exact up to rounding (rotating calipers).
  double minimal_rectangle_area(const Direction& direction) const;
  /// The box with one axis along r over that rectangle: V(M, r) of the `oriented` box model.
  OrientedBox box_along(const Direction& direction) const;

 private:
  Points points_, face_normals_;
  Eigen::VectorXd face_areas_;
  Eigen::Matrix<int, Eigen::Dynamic, 2> edges_, edge_faces_;
};

/// Box of minimal volume over all orientations, invariant under rigid motions to 1e-9 relative. Found on the Gauss map
/// of the hull: a minimal box has two adjacent faces that each contain a hull edge (O'Rourke 1985), so one of its
/// normals runs on an arc between the normals of two neighbouring hull faces.
OrientedBox minimal_oriented_box(const HullSupport& hull);

/// The box of the file's axes.
OrientedBox axis_aligned_box(const Points& points);

/// Axis-aligned box after the minimal rotation that takes z to r, expressed in the file's frame: V(M, r) of the
/// `frame` box model, which is what the authors' program computes.
OrientedBox frame_box(const Points& points, const Direction& direction);

}  // namespace stackabilization
