#pragma once

#include <string>
#include <vector>

#include "apps/improve/improve_run.h"
#include "stackabilization/improvement/partition.h"

namespace stackabilization::apps {

/// A piece of the object, where the diagnosis says that it stacks better taken apart.
struct PieceReport {
  std::string name;  ///< "piece_1"
  Piece piece;
  Shape shape;
  Stackability measured;  ///< along the direction of the piece
};

/// The pieces that the diagnosis offers, of the object as given; none where it offers no such thing.
std::vector<PieceReport> offered_pieces(const ImproveTask& task, const ImproveRun& run);

/// S of all pieces, each stacked with pieces of its own kind; see Partition. 0 without an offer.
double offered_stackability(const ImproveRun& run);

/// "seat, back: S 0.412 upwards"
std::string piece_text(const PieceReport& piece);

}  // namespace stackabilization::apps
