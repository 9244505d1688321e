#pragma once

#include <string>
#include <vector>

#include "apps/improve/improve_run.h"
#include "stackabilization/improvement/diagnosis.h"

namespace stackabilization::apps {

/// A piece of the object as given, which stacks better taken apart.
struct PieceReport {
  std::string name;  ///< "piece_1"
  Piece piece;
  Shape shape;
  Stackability measured;  ///< along the direction of the piece
};

/// The remedy that takes the object apart; null without one, or without a diagnosis.
const Remedy* offer_of_pieces(const Diagnosis* diagnosis);

/// The pieces of that remedy.
std::vector<PieceReport> pieces_of(const Remedy& offer, const ImproveTask& task);

/// "seat, back: S 0.412 along z"
std::string piece_text(const PieceReport& piece);

}  // namespace stackabilization::apps
