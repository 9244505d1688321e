#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

#include "improvement/quality/thickness.h"
#include "mesh/welded_mesh.h"
#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// A flat face of a part: connected triangles in one plane.
struct FlatFace {
  std::vector<std::int32_t> triangles;  ///< ascending
  std::vector<double> sides;            ///< per triangle, 1 if it faces as the first one, else -1
  std::vector<Eigen::Index> vertices;   ///< different corners, rows of Shape::vertices
  double area = 0;                      ///< model units squared
  double width = 0;                     ///< area by the diagonal of its box, model units
  double deviation = 0;                 ///< distance of a corner from the plane at rest, model units

  /// Returns the sum of the vector areas of the triangles on `shape`, all facing as the first one at rest,
  /// model units squared.
  Eigen::Vector3d area_vector(const Shape& shape) const;
  /// Returns the largest distance of a corner from the best plane on `shape`, model units.
  double deviation_on(const Shape& shape) const;
};

/// Returns the flat faces of the triangles of one part with an area of at least `min_share` of that part,
/// largest first. `mesh`: the welded shape. Triangles within tolerance::quality::coplanar of the first one of
/// a face belong to it.
std::vector<FlatFace> flat_faces(const Shape& shape, const WeldedMesh& mesh,
                                 const std::vector<std::int32_t>& triangles, double min_share);

/// A pair of faces of one part that are parallel.
struct ParallelFaces {
  std::size_t first = 0, second = 0;
  double angle = 0;  ///< at rest, radians
};
/// Returns the pairs of faces of one part that are parallel, within tolerance::quality::coplanar.
std::vector<ParallelFaces> parallel_faces(const Shape& shape, const std::vector<FlatFace>& faces);

/// Removes pairs of faces of one part that lie in different planes with no material between them: opposite
/// walls of a crate may lean, the two sides of a wall may not. `probes`: of the whole shape, at rest. A pair
/// of faces of which one has no probes stays.
void remove_pairs_across_air(const Shape& shape, const std::vector<FlatFace>& faces,
                             const std::vector<ThicknessProbe>& probes, std::vector<ParallelFaces>& pairs);

}  // namespace stackabilization::detail
