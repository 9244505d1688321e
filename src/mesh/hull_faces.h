#pragma once

#include <Eigen/Core>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Boundary of a convex hull as flat faces and straight edges; see HullSupport for the meaning of each field.
struct HullFaces {
  int dimension = 0;       ///< as HullSupport::dimension()
  Points points, normals;  ///< as HullSupport::points(), HullSupport::face_normals()
  Eigen::VectorXd areas;   ///< as HullSupport::face_areas()
  Eigen::Matrix<int, Eigen::Dynamic, 2> edges, edge_faces;  ///< as HullSupport::edges(), edge_faces()
};

/// Hull of any non-empty set of finite points. What counts as solid, flat, straight or a single point is
/// decided by `affine_span` with this resolution (model units), of the points and again of the corners that
/// are left; hull triangles within it of one plane are one face.
HullFaces hull_faces(const Points& points, double resolution);

}  // namespace stackabilization
