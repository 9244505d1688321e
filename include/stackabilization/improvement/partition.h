#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <vector>

#include "stackabilization/improvement/removal.h"

namespace stackabilization {

/// A piece of an object that is taken apart.
struct Piece {
  std::vector<int> parts;  ///< parts of the piece, rows of the whole structure, ascending
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< of largest S of the piece, of those tried
  double stackability = 0;  ///< S of the piece alone along `direction`; 0 for a piece without volume
};

/// A decomposition of an object into pieces.
struct Partition {
  std::vector<Piece> pieces;  ///< ordered by their first parts
  /// Eq. 3 for pieces that are each stacked with pieces of their own kind: 1 - sum_i V(piece_i) (1 - S_i) /
  /// V(M). It is the share of their boxes' volume that a long row of objects saves; S(M, r) itself for one
  /// piece.
  double stackability = 0;
};

/// Options of `suggested_partitions`.
struct PartitionOptions : RemovalOptions {
  std::size_t max_pieces = std::numeric_limits<std::size_t>::max();  ///< cuts into more pieces are left out
};

/// Finds where to cut an object so that its pieces stack well (paper, Fig. 14). For every class of symmetric
/// parts, all joints between the class and the other parts are cut; the components still connected by joints
/// are the pieces (legs cut off a top are one piece each). Cuts that separate nothing and cuts with the same
/// pieces as an earlier one are left out. Order: largest S first, ties with fewer pieces first.
/// `split_into_groups` makes the pieces. The result is the same for any number of threads. Throws UsageError
/// without directions, InputError when the whole shape has no volume.
std::vector<Partition> suggested_partitions(const StructuredShape& structured,
                                            const PartitionOptions& options = {});

}  // namespace stackabilization
