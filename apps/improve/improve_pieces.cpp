#include "apps/improve/improve_pieces.h"

#include <algorithm>

#include "apps/common/text.h"
#include "stackabilization/core/direction_text.h"

namespace stackabilization::apps {

const Remedy* offer_of_pieces(const Diagnosis* diagnosis) {
  if (!diagnosis) return nullptr;
  const auto found =
      std::find_if(diagnosis->remedies.begin(), diagnosis->remedies.end(),
                   [](const Remedy& remedy) { return remedy.kind == Remedy::Kind::take_apart; });
  return found == diagnosis->remedies.end() ? nullptr : &*found;
}

std::vector<PieceReport> pieces_of(const Remedy& offer, const ImproveTask& task) {
  std::vector<std::vector<int>> groups;
  for (const Piece& piece : offer.pieces) groups.push_back(piece.parts);
  StackabilityOptions measure = task.checker().requirements().measure;
  measure.flat_shapes = FlatShapes::measure;
  std::vector<PieceReport> pieces;
  for (const StructuredShape& shape : split_into_groups(task.rest(), groups)) {
    const Piece& piece = offer.pieces[pieces.size()];
    pieces.push_back({"piece_" + std::to_string(pieces.size() + 1), piece, shape.shape,
                      stackability(shape.shape, Direction(piece.direction), measure)});
  }
  return pieces;
}

std::string piece_text(const PieceReport& piece) {
  return joined(piece.shape.part_names) + ": S " + stackability_text(piece.piece.stackability) + " " +
         direction_text(piece.piece.direction);
}

}  // namespace stackabilization::apps
