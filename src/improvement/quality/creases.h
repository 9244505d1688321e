#pragma once

#include <cstdint>
#include <vector>

#include "improvement/quality/affine_fit.h"
#include "mesh/welded_mesh.h"
#include "stackabilization/improvement/quality.h"

namespace stackabilization::detail {

/// Edges at which a surface is smooth at rest, and the creases that it gets there: the measure creases.
class Creases {
 public:
  /// Finds the edges between two triangles that fold by less than tolerance::quality::smooth_fold, but for
  /// those of needles, whose planes are mostly rounding. `diagonal`: of the object, model units.
  Creases(const Shape& rest, const WeldedMesh& welded, double diagonal);

  /// Measures the length at rest of the edges that have become creases: in full from a change of the fold of
  /// tolerance::quality::full_crease on, in part above that of tolerance::quality::slight_crease. Where two
  /// parts of one surface meet, in the triangles at the vertices that they share, what the parts turn against
  /// each other is no crease: it comes off the change. `maps`: of the parts to `now`.
  QualityValue measure(const Shape& now, const std::vector<AffineMap>& maps) const;

 private:
  struct SmoothEdge {
    std::int32_t left, right;  ///< triangles
    std::int32_t corner;       ///< vertex of `right` across the edge
    std::int32_t on_edge;      ///< a vertex of the edge
    bool flipped;              ///< whether the two triangles are oriented against each other
    double fold;               ///< at rest, radians; negative where the surface is concave
    double length;             ///< at rest, of the diagonal
    double still;              ///< cosine of the folds between which no crease can be
    std::int32_t joined;       ///< part that meets the one of `left` here; that one itself elsewhere
  };

  /// Returns the fold of the surface at an edge, radians; negative where it is concave. `left`, `right`: unit
  /// normals.
  static double fold(const SmoothEdge& edge, const Shape& shape, const Eigen::Vector3d& left,
                     const Eigen::Vector3d& right);

  std::vector<SmoothEdge> edges_;
};

}  // namespace stackabilization::detail
