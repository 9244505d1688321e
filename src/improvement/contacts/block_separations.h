#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/separation.h"

namespace stackabilization::detail {

/// A block of the copy below and one of the copy above.
struct BlockPair {
  int upper = 0, lower = 0;
  double f = 0;  ///< what it asked for when it was found, model units
};

/// What a pair asks for.
struct BlockSeparation {
  bool blocked = false;  ///< false: the blocks pass each other at any height
  /// Their separation along r, within 1e-12 of the extent, model units. Not blocked: the least that they
  /// would ask for if they met, that of the lowest and the highest point.
  double f = 0;
};

/// A shape in blocks that stay the same while it deforms: its parts, cut into slabs across r by the heights
/// of triangles at rest. f_max is the maximum over all pairs of blocks; that of one pair changes far more
/// smoothly with the shape. Const, safe from any number of threads.
class BlockSeparations {
 public:
  /// `rest`: the shape that the blocks are made of; `most_slabs`: into which a part is cut.
  BlockSeparations(const Shape& rest, const Direction& direction, Semantics semantics, int most_slabs = 12);

  /// Pairs that are blocked and ask for at least `least` in a shape with the triangles of `rest`, those that
  /// ask for most first.
  std::vector<BlockPair> pairs_above(const Shape& shape, double least) const;
  /// What each of `pairs` asks for.
  std::vector<BlockSeparation> separations(const Shape& shape, const std::vector<BlockPair>& pairs) const;

 private:
  struct Block {
    std::vector<std::int32_t> vertices;  ///< rows of the shape
    Triangles triangles;                 ///< of those, and a triangle without size at the anchor
  };

  struct Placed;  ///< a block of a deformed shape

  /// A point beside the shape that becomes the origin and is put into every block. It meets nothing but
  /// itself, and keeps separation trees from choosing an origin each, which would have them built again for
  /// every pair.
  Eigen::Vector3d anchor(const Shape& shape) const;
  Placed placed(const Shape& shape, int block, const Eigen::Vector3d& anchor) const;
  BlockSeparation separation(const Placed& upper, const Placed& lower) const;

  std::vector<Block> blocks_;
  Direction direction_;
  Frame frame_;
  Semantics semantics_;
};

}  // namespace stackabilization::detail
