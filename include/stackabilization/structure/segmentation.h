#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Method of `segmented`.
enum class SegmentationMethod {
  given,  ///< the parts of the shape, unchanged
  /// The parts of the shape, and of a part that one primitive represents badly its members: the legs and
  /// rails of a frame that is one part of the file. Member k of part "frame" is called "frame.k". A triangle
  /// that is flat to a line belongs to the part of the surface beside its longest edge, whatever its label.
  members,
  whole,       ///< one part, for shapes that deform as a whole, such as a basket of many wires
  components,  ///< connected components; two components that touch over a large area are merged
  /// Components, each cut along concave edges (Hoffman and Richards 1984), and what these do not cut by
  /// hierarchical fitting of primitives (Attene et al. 2006).
  primitives,
  shape_diameter,  ///< components, each cut by the shape-diameter function (Shapira et al. 2008, CGAL)
  /// `members` when the shape has several parts. Otherwise `whole` for a net of wires. Otherwise, when there
  /// are several components, these, of which those that one primitive represents badly are cut into members.
  /// Otherwise `whole` for a body of revolution. Otherwise `primitives`.
  automatic,
};

/// Options of `segmented`.
struct SegmentationOptions {
  SegmentationMethod method = SegmentationMethod::automatic;  ///< segmentation method
  /// Number of parts per component. 0: the method determines the number.
  int parts = 0;
  /// Smallest area of a part, fraction of the area of its component, in [0, 1). A smaller segment joins a
  /// neighbour.
  double min_part_area = 0.005;
};

/// Segments a shape: returns it with new parts, and with the same vertices and triangles in the same order.
/// Parts are named "part_1", "part_2", ... by descending area. The names stay with `given`, and when one part
/// stays one part. Boundaries between parts are short and follow concave edges. A shape of one component is
/// cut alike on both sides of its planes of symmetry, unless a number of parts is given. Deterministic.
///
/// `primitives` looks for parts that fit a cuboid, a solid of revolution or a ring, not for single faces. It
/// takes apart first what sharp concave edges separate all around, as the bodies of a boolean union, unless a
/// number of parts is given; both sides of a wall stay together. Within what is left it merges the patches of
/// Attene et al. (2006) as long as the solid behind them fills its primitive. Concave edges between patches
/// count against a merge. Cavities that the shape itself encloses count as filled, so that a vessel is one
/// part. Where half of a surface or more is a body of revolution, that body is one part, unless a number of
/// parts is given. The method orients a component such that its volume is positive. `shape_diameter` does not
/// cut a component for which CGAL computes no diameter: sheets and meshes of very few triangles. It may
/// return fewer parts than requested.
///
/// A part is connected over the surface, or through a wall where other parts lie between.
///
/// Guarantee: every triangle belongs to exactly one part, also in open, non-manifold and disconnected shapes.
/// Throws UsageError for options out of range, and InputError when `validate(shape)` fails or, where the
/// parts of the shape are kept or cut into members, one of several has no area.
Shape segment(const Shape& shape, const SegmentationOptions& options = {});

/// Triangles that the user marked as members of a part.
struct PartSeeds {
  std::string name;                     ///< name of the part
  std::vector<std::int32_t> triangles;  ///< rows of Shape::triangles; at least one
};

/// Segments a shape interactively (after Meng et al. 2011): every triangle joins the part with the nearest
/// seed. The distance is measured over the surface; crossing a concave edge is the most expensive step. A
/// component without seeds joins the part that is nearest in space. The parts of `shape` have no influence.
/// Throws UsageError when a part has no seed, and when a seed triangle does not exist or occurs twice.
Shape segment(const Shape& shape, const std::vector<PartSeeds>& seeds);

}  // namespace stackabilization
