#pragma once

#include <Eigen/Core>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Boundary of a convex hull as flat faces and straight edges. HullSupport defines the members.
struct HullFaces {
  int dimension = 0;       ///< as HullSupport::dimension()
  Points points, normals;  ///< as HullSupport::points(), HullSupport::face_normals()
  Eigen::VectorXd areas;   ///< as HullSupport::face_areas()
  Eigen::Matrix<int, Eigen::Dynamic, 2> edges, edge_faces;  ///< as HullSupport::edges(), edge_faces()
};

/// Computes the hull faces of a non-empty set of finite points. `affine_span` with this resolution (model
/// units) determines whether the set is solid, flat, straight or a single point, first for all points and
/// then for the remaining corners. Hull triangles within the resolution of one plane form one face.
HullFaces hull_faces(const Points& points, double resolution);

}  // namespace stackabilization
