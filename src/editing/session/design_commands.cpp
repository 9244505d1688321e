// Commands that change the design or move in the tree of designs.
#include <algorithm>
#include <utility>

#include "core/angles.h"
#include "editing/session/handle_range.h"
#include "editing/session/session_implementation.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/rebase.h"
#include "stackabilization/improvement/refinement.h"

namespace stackabilization::editing {

namespace {

/// Sine of the angle below which two drags are along one line: an amount that was possible is tried first.
constexpr double same_line_sine = 1.0 / 128;

/// Returns the share of `wanted` that `made` is, where both are moves of one handle along one line.
double known_share(const Edit& made, const Edit& wanted) {
  const auto* a = std::get_if<Move>(&made.operation);
  const auto* b = std::get_if<Move>(&wanted.operation);
  if (!a || !b || made.handle != wanted.handle || !(b->by.squaredNorm() > 0)) return 0;
  const double share = a->by.dot(b->by) / b->by.squaredNorm();
  return detail::on_one_line(a->by, b->by, same_line_sine) ? share : 0;
}

}  // namespace

void EditingSession::Implementation::run(const ApplySuggestion& command) {
  expect_row(command.number, advice_.suggestions.size(), "suggestion");
  const OfferedEdit offered = advice_.suggestions[static_cast<std::size_t>(command.number)];
  const ContactEdit& edit = offered.suggestion.edit;
  HistoryNode node =
      node_with({edit.edit}, node_name(offered.explanation, describe(edit.reason, part_names())));
  node.stackability = offered.suggestion.measured.value;
  node.energy = offered.suggestion.energy.value;
  add_node(std::move(node), offered.design);
}

void EditingSession::Implementation::run(const Drag& command) {
  if (!range_runs_) lanes_.cancel(Lane::advice);
  const double known = drag_ ? known_share(drag_->edit, command.edit) : 0;
  EditedFrom from = from_current();
  from.scope = QualityScope::parts;
  LargestEdit largest = largest_part(from, command.edit, known);
  drag_ = DragState{std::move(largest.made), with_magnitude(command.edit, largest.amount)};
  emit(Changed{Change::design});
  if (largest.obstacle) emit(Refused{*largest.obstacle});
}

void EditingSession::Implementation::run(const EndDrag& command) {
  const std::optional<DragState> drag = std::exchange(drag_, std::nullopt);
  if (!drag) return;
  const auto is_current = [&](const MeasuredDesign& design) {
    return design.design->shape.vertices == current_.design->shape.vertices;
  };
  if (!command.keep || is_current(drag->design)) {
    emit(Changed{Change::design});
    return;
  }
  const LargestEdit kept = largest_part(from_current(), drag->edit, 0);
  if (is_current(kept.made))
    emit(Changed{Change::design});
  else
    keep_edit(with_magnitude(drag->edit, kept.amount), kept.made);
  if (kept.obstacle) emit(Refused{*kept.obstacle});
}

void EditingSession::Implementation::keep_edit(const Edit& edit, const MeasuredDesign& made) {
  const Explanation words = explain(rebase(workspace_->space().rest(), *current_.design), made.design->shape,
                                    {.edits = {edit}, .reasons = {}});
  HistoryNode node = node_with({edit}, node_name(words, describe(edit, part_names())));
  node.stackability = made.assessment.measured.value;
  node.energy = made.energy.value;
  add_node(std::move(node), made.design);
}

void EditingSession::Implementation::run(const FindRange& command) {
  validate(command.edit, structure().diagonal);
  lanes_.cancel(Lane::advice);
  wanted_range_ = command.edit;
  advice_.range.reset();
  emit(Changed{Change::range});
}

void EditingSession::Implementation::run(const RollBack& command) {
  expect_row(command.node, history().nodes.size(), "node");
  if (command.node != history().current) visit(command.node);
}

void EditingSession::Implementation::run(const Undo& /*command*/) {
  if (document_.place > 0) return go_to_place(document_.place - 1);
  if (earlier_.empty()) return;
  Document earlier = std::move(earlier_.back());
  earlier_.pop_back();
  load(std::move(earlier));
}

void EditingSession::Implementation::run(const Redo& /*command*/) {
  if (document_.place + 1 < document_.visited.size()) go_to_place(document_.place + 1);
}

void EditingSession::Implementation::run(const TakeDesign& command) {
  const auto one = std::find_if(found_.designs.begin(), found_.designs.end(),
                                [&](const FoundDesign& each) { return each.number == command.number; });
  if (one == found_.designs.end())
    throw UsageError("design " + std::to_string(command.number) +
                     " is none of those found: a better one may have taken its place");
  const Candidate candidate = one->candidate;
  HistoryNode node =
      node_with(candidate.design.edits, node_name(one->explanation, "design " + std::to_string(one->number)));
  node.constraints = workspace_->constraints(Direction(candidate.direction));
  node.direction = candidate.direction;
  node.stackability = candidate.measured.value;
  node.energy = candidate.energy.value;
  const DeformationResult again = workspace_->space().deformed(node.edits, node.constraints);
  if (again.refusal) throw UsageError(describe(*again.refusal, structure()));
  history() = roll_back(std::move(history()), 0);
  add_node(std::move(node), std::make_shared<const Design>(again.design));
}

void EditingSession::Implementation::run(const TakeEdit& command) {
  expect_row(command.node, history().nodes.size(), "node");
  const std::vector<Edit> edits = history().nodes[static_cast<std::size_t>(command.node)].edits;
  expect_row(command.edit, edits.size(), "edit");
  const Edit& edit = edits[static_cast<std::size_t>(command.edit)];
  const EditedFrom from = from_current();
  const TriedEdit tried = try_edit(from, edit);
  if (!tried.made)
    throw UsageError("this edit cannot be made here: " +
                     describe(*tried.obstacle, workspace_->space().rest().structure));
  keep_edit(edit, measured(from, tried.made));
}

}  // namespace stackabilization::editing
