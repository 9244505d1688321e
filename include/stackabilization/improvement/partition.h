#pragma once

#include <Eigen/Core>
#include <vector>

#include "stackabilization/improvement/removal.h"

namespace stackabilization {

/// One piece of an object that was taken apart.
struct Piece {
  std::vector<int> parts;                                ///< rows of the whole structure, ascending
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< along which it stacks best, of those tried
  double stackability = 0;  ///< S of the piece alone along it; 0 for a piece without volume
};

/// A way to take an object apart.
struct Partition {
  std::vector<Piece> pieces;  ///< by their first parts
  /// Eq. 3 for the pieces, each stacked with its own kind: 1 - sum_i V(piece_i) (1 - S_i) / V(M). What a long
  /// row of objects saves of their boxes; S(M, r) itself when there is one piece.
  double stackability = 0;
};

/// Where to cut an object so that its pieces stack well (paper, Fig. 14): for every class of symmetric parts,
/// all joints between it and the other parts are cut, and what then still hangs together through joints is a
/// piece (legs apart from the top are one piece each). Cuts that part nothing, or differ in nothing from
/// others, are left out; best first, ties with fewer pieces first. The same for any number of threads.
/// `partitioned` makes the pieces. Throws UsageError without directions, InputError when the whole has no
/// volume.
std::vector<Partition> suggested_partitions(const StructuredShape& structured,
                                            const RemovalOptions& options = {});

}  // namespace stackabilization
