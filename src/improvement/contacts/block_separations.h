#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/separation.h"

namespace stackabilization::detail {

/// A block of the copy below (`upper`) and a block of the copy above (`lower`).
struct BlockPair {
  int upper = 0, lower = 0;
  double f = 0;  ///< separation of the two blocks when the pair was found, model units
  /// Least distance, model units, by which the lower block has to move across r so that the pair is no longer
  /// in the way above the separation that was asked for. An estimate: that of the convex hulls of what meets
  /// there, over some directions across r.
  double overlap = 0;
};

/// Separation of a pair of blocks.
struct BlockSeparation {
  bool blocked = false;  ///< false: the blocks pass each other at any height
  /// Separation along r, model units, within 1e-12 of the extent. If not blocked, a lower bound of any
  /// separation of the two blocks: the lowest point of the block below minus the highest point of the block
  /// above.
  double f = 0;
};

/// Decomposition of a shape into blocks that stay the same while the shape deforms: its parts, cut into slabs
/// across r by the heights of the triangles at rest. f_max is the maximum of the separations over all pairs
/// of blocks. The separation of one pair is a far smoother function of the shape than f_max. Const, safe from
/// any number of threads.
class BlockSeparations {
 public:
  /// `rest`: shape that defines the blocks. `max_slabs`: largest number of slabs per part.
  BlockSeparations(const Shape& rest, const Direction& direction, ContactSemantics semantics,
                   int max_slabs = 12);

  /// Returns the blocked pairs whose separation in `shape` is at least `least` (model units), largest
  /// separation first, with their overlaps. `shape` must have the triangles of `rest`.
  std::vector<BlockPair> pairs_above(const Shape& shape, double least) const;
  /// Computes the separation of each of `pairs` in `shape`.
  std::vector<BlockSeparation> separations(const Shape& shape, const std::vector<BlockPair>& pairs) const;

 private:
  struct Block {
    std::vector<std::int32_t> vertices;  ///< rows of the shape
    /// Triangles of the block, as rows of `vertices`, and a triangle without size at the anchor (the row
    /// after the last vertex).
    Triangles triangles;
  };

  struct Placed;  ///< a block of a deformed shape

  /// Returns a point beside the shape. It becomes the origin and is added to every block. It collides with
  /// nothing but itself. All separation trees then use the same origin; with an origin each they would be
  /// built again for every pair.
  Eigen::Vector3d anchor(const Shape& shape) const;
  Placed placed(const Shape& shape, int block, const Eigen::Vector3d& anchor) const;
  BlockSeparation separation(const Placed& upper, const Placed& lower) const;
  /// Returns BlockPair::overlap of two blocks for copies at a distance of `lift`, model units.
  double overlap(const Placed& upper, const Placed& lower, double lift) const;

  std::vector<Block> blocks_;
  Direction direction_;
  Frame frame_;
  ContactSemantics semantics_;
};

}  // namespace stackabilization::detail
