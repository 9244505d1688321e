#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// How `segmented` finds parts.
enum class SegmentationMethod {
  given,           ///< the parts of the shape as they are
  whole,           ///< one part, for what follows as a whole: a basket of many wires
  components,      ///< connected components, those that touch over an area merged
  primitives,      ///< components, each cut by hierarchical fitting of primitives (Attene et al. 2006)
  shape_diameter,  ///< components, each cut by the shape-diameter function (Shapira et al. 2008, CGAL)
  automatic,       ///< given when the shape has several parts; else whole for a net of wires; else components
                   ///< when there are several or the whole is a body of revolution; else primitives
};

/// Options of `segmented`.
struct SegmentationOptions {
  SegmentationMethod method = SegmentationMethod::automatic;  ///< how parts are found
  int parts = 0;  ///< parts to end with per component; 0: as many as the shape has by the method's measure
  /// Crumbs below this share of the component's area join a neighbour; in [0, 1).
  double min_part_area = 0.005;
};

/// `shape` with its parts replaced: same vertices and triangles in the same order. Parts are called "part_1"
/// and on, largest area first, except with `given` and where one part stays one: that keeps its name.
/// Boundaries between parts run along short, concave paths; every part of a component is connected.
/// Deterministic.
///
/// `primitives` cuts for parts that a cuboid, a solid of revolution or a ring holds, not for single faces:
/// the patches of Attene et al. are joined on as long as the solid behind them fills its primitive, concave
/// edges keeping parts asunder; hollows that the shape itself closes in count as filled, so that a vessel is
/// one part. It takes the side from which a component has positive volume for its outside. `shape_diameter`
/// leaves a component whole where CGAL finds no diameter (sheets, very few triangles), and may end with fewer
/// parts than asked for.
///
/// Guarantee: one label per triangle, also for open, non-manifold and several-shelled shapes. Throws
/// UsageError for options outside their ranges and InputError when `validate(shape)` fails.
Shape segment(const Shape& shape, const SegmentationOptions& options = {});

/// Triangles that a user has marked as belonging to a part.
struct PartSeeds {
  std::string name;                     ///< of the part
  std::vector<std::int32_t> triangles;  ///< at least one
};

/// Interactive segmentation (after Meng et al. 2011): every triangle gets the part whose seeds it is nearest
/// to, over the surface, where crossing a concave edge costs most. `shape`'s own parts are not looked at.
/// Components without seeds go to the part that is nearest in space. Throws UsageError when a part has no
/// seed, a triangle is seeded twice or does not exist.
Shape segment(const Shape& shape, const std::vector<PartSeeds>& seeds);

}  // namespace stackabilization
