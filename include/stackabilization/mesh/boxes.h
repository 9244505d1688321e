#pragma once

#include <Eigen/Core>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"

namespace stackabilization {

/// An oriented box: centre, right-handed orthonormal axes, and half extents along the axes.
struct OrientedBox {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();        ///< model units
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();      ///< columns are unit vectors
  Eigen::Vector3d half_extents = Eigen::Vector3d::Zero();  ///< along the columns of `axes`, model units, >= 0

  double volume() const { return 8 * half_extents.prod(); }  ///< model units cubed
};

/// Outline of a convex body that is seen along a direction.
struct Silhouette {
  std::vector<int> corners;  ///< m rows of HullSupport::points(), counter-clockwise in u, v of the frame
  Eigen::Matrix2Xd polygon;  ///< 2 x m, those corners in u, v relative to the centre of the bounding box
};

/// Convex hull, prepared for box and extent queries in many directions. Built once per shape, safe to share
/// between threads.
class HullSupport {
 public:
  /// Computes the hull of the vertices that triangles use. Accepts flat, straight and single-point sets.
  explicit HullSupport(const Shape& shape);
  /// Computes the hull of points. The order and the repetition of points have no influence: the same set
  /// gives the same bits. Throws InputError when there is no point or a coordinate is not finite.
  explicit HullSupport(const Points& points);

  /// Returns the dimension of the set up to rounding (tolerance::rounding): 0 one point, 1 straight, 2 flat,
  /// 3 solid. Only the box of a solid set has a volume.
  int dimension() const { return dimension_; }
  /// Returns the k x 3 extreme points in lexicographic order. Points on a face or an edge of the hull are
  /// omitted, also those that rounding (tolerance::rounding) lifted slightly above it.
  const Points& points() const { return points_; }
  /// Returns the f x 3 unit outward normals of the hull faces, largest face first. Coplanar triangles form
  /// one face. A flat set has the two normals of its plane; straight and single-point sets have none.
  const Points& face_normals() const { return face_normals_; }
  /// Returns the f areas of those faces, model units squared.
  const Eigen::VectorXd& face_areas() const { return face_areas_; }
  /// Returns the hull edges between faces that are not coplanar: e x 2 rows of `points()`. The edges of a
  /// flat set are the sides of its convex polygon, between its two normals. Straight and single-point sets
  /// have none.
  const Eigen::Matrix<int, Eigen::Dynamic, 2>& edges() const { return edges_; }
  /// Returns, per row of `edges()`, the two adjacent faces: e x 2 rows of `face_normals()`.
  const Eigen::Matrix<int, Eigen::Dynamic, 2>& edge_faces() const { return edge_faces_; }

  /// Returns the heights of `points()` along a unit vector, above the centre of the bounding box; model
  /// units.
  Eigen::VectorXd heights_along(const Eigen::Vector3d& unit) const { return centred_points_ * unit; }
  /// Computes h(M, r): the extent along r / |r|, model units.
  double extent(const Direction& direction) const;
  /// Computes the area of the minimal-area rectangle around the projection along r, model units squared.
  /// Exact up to rounding. Rotating calipers (Toussaint 1983) around the silhouette.
  double minimal_rectangle_area(const Direction& direction) const;
  /// Returns the box with one axis along r over that rectangle. Its volume is V(M, r) of the `oriented` box
  /// model.
  OrientedBox box_along(const Direction& direction) const;
  /// Returns the outline seen along `frame.w`. It follows from the signs of the face normals along w.
  Silhouette silhouette(const Frame& frame) const;

 private:
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;

  int dimension_ = 0;
  Points points_, face_normals_;
  Eigen::VectorXd face_areas_;
  Eigen::Matrix<int, Eigen::Dynamic, 2> edges_, edge_faces_;
  Eigen::Vector3d centre_ =
      Eigen::Vector3d::Zero();  ///< taken off before projecting: keeps digits far from the origin
  Columns centred_points_, normal_columns_;  ///< column by column, for fast products
  double resolution_ = 0;                    ///< tolerance::rounding in model units
};

/// Number of corners from which on a hull is searched in part first, see minimal_oriented_box.
inline constexpr Eigen::Index large_hull = 1000;

/// Computes a box of minimal volume over all orientations. The volume is the same in every pose to 1e-9
/// relative.
///
/// A minimal box has two adjacent faces that each contain a hull edge (O'Rourke 1985), so one of its normals
/// lies on an arc of the Gauss map between the normals of two neighbouring hull faces. The function searches
/// these arcs by branch and bound: the corners that support a box bound the boxes along directions nearby
/// from below, but for terms of second order. It stops after a fixed amount of work, which spheres of some
/// hundred faces need. For hulls of more than 1000 corners, it searches the hull of 500 that are spread
/// evenly, and follows the best directions on the whole hull. The result is therefore the best box found, not
/// proven minimal.
OrientedBox minimal_oriented_box(const HullSupport& hull);

/// Computes the box along the file's axes.
OrientedBox axis_aligned_box(const Points& points);

/// Computes the axis-aligned box after the minimal rotation from z to r, and returns it in the file's frame.
/// Its volume is V(M, r) of the `frame` box model, which the authors' program uses.
OrientedBox frame_box(const Points& points, const Direction& direction);

}  // namespace stackabilization
