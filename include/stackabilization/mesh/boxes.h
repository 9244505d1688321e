#pragma once

#include <Eigen/Core>
#include <array>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"

namespace stackabilization {

/// A box: centre, right-handed orthonormal axes (columns), half extents along them, model units.
struct OrientedBox {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();        ///< model units
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();      ///< columns are unit vectors
  Eigen::Vector3d half_extents = Eigen::Vector3d::Zero();  ///< along the columns of `axes`, model units, >= 0

  double volume() const { return 8 * half_extents.prod(); }  ///< model units cubed
};

/// Convex hull prepared for box and extent queries in many directions; one per shape, safe to share between
/// threads.
class HullSupport {
 public:
  /// Hull of the vertices that triangles use. Flat, straight and single-point sets are accepted.
  explicit HullSupport(const Shape& shape);
  /// Throws InputError when there is no point or a coordinate is not finite. The order and repetition of
  /// points do not matter: the same set gives the same bits.
  explicit HullSupport(const Points& points);

  /// Of the set up to rounding (tolerance::rounding): 0 one point, 1 straight, 2 flat, 3 solid. The box of a
  /// solid set, and of no other, has a volume.
  int dimension() const { return dimension_; }
  /// k x 3 extreme points in lexicographic order. Points that lie on a face or edge of the hull are left out,
  /// also where rounding (tolerance::rounding) lifted them a little above it.
  const Points& points() const { return points_; }
  /// f x 3 unit outward normals of the hull faces (coplanar triangles merged), largest face first; for a flat
  /// set the two normals of its plane; empty for straight and single-point sets.
  const Points& face_normals() const { return face_normals_; }
  /// f areas of those faces, model units squared.
  const Eigen::VectorXd& face_areas() const { return face_areas_; }
  /// e x 2 rows of `points()`: hull edges between faces that are not coplanar. For a flat set the sides of
  /// its convex polygon, between its two normals; empty for straight and single-point sets.
  const Eigen::Matrix<int, Eigen::Dynamic, 2>& edges() const { return edges_; }
  /// Per row of `edges()` the two faces beside it, rows of `face_normals()`; e x 2.
  const Eigen::Matrix<int, Eigen::Dynamic, 2>& edge_faces() const { return edge_faces_; }

  /// h(M, r): extent along r / |r|, model units.
  double extent(const Direction& direction) const;
  /// Area of the minimal-area rectangle that holds the projection along r. Exact up to rounding: rotating
  /// calipers (Toussaint 1983) around the silhouette, which is read off the signs of the face normals along
  /// r.
  double minimal_rectangle_area(const Direction& direction) const;
  /// The box with one axis along r over that rectangle: V(M, r) of the `oriented` box model.
  OrientedBox box_along(const Direction& direction) const;

 private:
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;
  /// 2 x m counter-clockwise corners of the projection in u, v of `frame`, relative to the centre.
  Eigen::Matrix2Xd projection(const Frame& frame) const;

  int dimension_ = 0;
  Points points_, face_normals_;
  Eigen::VectorXd face_areas_;
  Eigen::Matrix<int, Eigen::Dynamic, 2> edges_, edge_faces_;
  Eigen::Vector3d centre_ =
      Eigen::Vector3d::Zero();  ///< taken off before projecting: keeps digits far from the origin
  Columns centred_points_, normal_columns_;  ///< column by column, for fast products
  double resolution_ = 0;                    ///< tolerance::rounding in model units
};

/// Box of minimal volume over all orientations, its volume the same in every pose to 1e-9 relative. Looked
/// for on the Gauss map of the hull: a minimal box has two adjacent faces that each contain a hull edge
/// (O'Rourke 1985), so one of its normals runs on an arc between the normals of two neighbouring hull faces.
/// Best-first search of these arcs: where a minimum can hide is estimated from how fast the boxes at both
/// ends of an interval grow when they turn, and an interval below a hundredth of a radian is taken to have
/// one minimum. So the result is the best box met, not proven minimal. For hulls of more than some hundreds
/// of faces (finely cut spheres) the search stops, at the same place in every pose, after a fixed amount of
/// work.
OrientedBox minimal_oriented_box(const HullSupport& hull);

/// The box of the file's axes.
OrientedBox axis_aligned_box(const Points& points);

/// Axis-aligned box after the minimal rotation that takes z to r, expressed in the file's frame: V(M, r) of
/// the `frame` box model, which is what the authors' program computes.
OrientedBox frame_box(const Points& points, const Direction& direction);

}  // namespace stackabilization
