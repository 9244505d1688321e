#include "apps/improve/improve_pieces.h"

#include <algorithm>

#include "apps/common/text.h"
#include "stackabilization/core/direction_text.h"

namespace stackabilization::apps {

namespace {

/// The offer to take the object apart; null without one.
const Remedy* offer_of(const ImproveRun& run) {
  if (!run.result.diagnosis) return nullptr;
  const std::vector<Remedy>& remedies = run.result.diagnosis->remedies;
  const auto found = std::find_if(remedies.begin(), remedies.end(), [](const Remedy& remedy) {
    return remedy.kind == Remedy::Kind::take_apart;
  });
  return found == remedies.end() ? nullptr : &*found;
}

}  // namespace

std::vector<PieceReport> offered_pieces(const ImproveTask& task, const ImproveRun& run) {
  const Remedy* const offer = offer_of(run);
  if (!offer) return {};
  std::vector<std::vector<int>> groups;
  for (const Piece& piece : offer->pieces) groups.push_back(piece.parts);
  StackabilityOptions measure = task.checker().requirements().measure;
  measure.flat_shapes = FlatShapes::measure;
  std::vector<PieceReport> reports;
  for (const StructuredShape& shape : split_into_groups(task.rest(), groups)) {
    const Piece& piece = offer->pieces[reports.size()];
    reports.push_back({"piece_" + std::to_string(reports.size() + 1), piece, shape.shape,
                       stackability(shape.shape, Direction(piece.direction), measure)});
  }
  return reports;
}

double offered_stackability(const ImproveRun& run) {
  const Remedy* const offer = offer_of(run);
  return offer ? offer->stackability : 0;
}

std::string piece_text(const PieceReport& piece) {
  return joined(piece.shape.part_names) + ": S " + stackability_text(piece.piece.stackability) + " " +
         direction_text(piece.piece.direction);
}

}  // namespace stackabilization::apps
