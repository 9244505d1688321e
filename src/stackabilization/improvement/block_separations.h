#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "stackabilization/envelope/separation.h"
#include "stackabilization/shape/direction.h"
#include "stackabilization/shape/shape.h"

namespace stackabilization::detail {

/// A block of the copy below and one of the copy above.
struct BlockPair {
  int upper = 0, lower = 0;
  double f = 0;  ///< see BlockSeparations::separations, model units
};

/// A shape in blocks that stay the same while it deforms: its parts, cut into slabs across r by the heights
/// of triangles at rest. f_max is the maximum over all pairs of blocks; that of one pair changes far more
/// smoothly with the shape. Const, safe from any number of threads.
class BlockSeparations {
 public:
  /// `rest`: the shape that the blocks are made of; `most_slabs`: into which a part is cut.
  BlockSeparations(const Shape& rest, const Direction& direction, Semantics semantics, int most_slabs = 12);

  /// Pairs with f >= `least` in a shape with the triangles of `rest`, largest f first.
  std::vector<BlockPair> pairs_above(const Shape& shape, double least) const;
  /// f of each of `pairs`, model units: the separation of the two blocks along r, within 1e-12 of the extent.
  /// A pair that passes at any height is given what it would ask for if lowest and highest points met, which
  /// no pair that meets falls below.
  std::vector<double> separations(const Shape& shape, const std::vector<BlockPair>& pairs) const;

 private:
  struct Block {
    std::vector<std::int32_t> vertices;  ///< rows of the shape
    Triangles triangles;                 ///< of those
  };

  struct Placed;  ///< a block of a deformed shape

  Placed placed(const Shape& shape, int block) const;
  double separation(const Placed& upper, const Placed& lower) const;

  std::vector<Block> blocks_;
  Direction direction_;
  Frame frame_;
  Semantics semantics_;
};

}  // namespace stackabilization::detail
