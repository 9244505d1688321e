#include "stackabilization/editing/session.h"

#include <utility>

#include "editing/session/session_implementation.h"

namespace stackabilization::editing {

EditingSession::EditingSession(Document document, SessionOptions options, Listener listener)
    : implementation_(
          std::make_unique<Implementation>(std::move(document), std::move(options), std::move(listener))) {}

EditingSession::~EditingSession() = default;

void EditingSession::execute(const Command& command) {
  implementation_->execute(command);
}

void EditingSession::open(Document document, SessionOptions options) {
  implementation_->open(std::move(document), std::move(options));
}

std::optional<EditingSession::Job> EditingSession::next_job(Lane lane) {
  return implementation_->next_job(lane);
}

void EditingSession::cancel() {
  implementation_->lanes_.cancel_all();
}

const Document& EditingSession::document() const {
  return implementation_->document_;
}

bool EditingSession::saved() const {
  return !implementation_->options_.autosave.empty() && !implementation_->unsaved_;
}

const DeformationModel& EditingSession::space() const {
  return implementation_->workspace_->space();
}

const RequirementChecker& EditingSession::checker() const {
  return implementation_->workspace_->checker();
}

const Direction& EditingSession::direction() const {
  return implementation_->direction_;
}

const Stackability& EditingSession::at_rest() const {
  return implementation_->at_rest_;
}

const MeasuredDesign& EditingSession::current() const {
  return implementation_->current_;
}

const MeasuredDesign& EditingSession::shown() const {
  return implementation_->drag_ ? implementation_->drag_->design : implementation_->current_;
}

std::optional<Edit> EditingSession::drag() const {
  return implementation_->drag_ ? std::optional(implementation_->drag_->edit) : std::nullopt;
}

bool EditingSession::dragging() const {
  return implementation_->drag_.has_value();
}

bool EditingSession::can_undo() const {
  return implementation_->document_.place > 0 || !implementation_->earlier_.empty();
}

bool EditingSession::can_redo() const {
  return implementation_->document_.place + 1 < implementation_->document_.visited.size();
}

const std::optional<Review>& EditingSession::review() const {
  return implementation_->advice_.review;
}

const std::vector<OfferedEdit>& EditingSession::suggestions() const {
  return implementation_->advice_.suggestions;
}

bool EditingSession::suggestions_complete() const {
  return implementation_->advice_.complete;
}

const std::vector<ObstacleCount>& EditingSession::refused() const {
  return implementation_->advice_.refused;
}

const std::optional<Diagnosis>& EditingSession::diagnosis() const {
  return implementation_->advice_.diagnosis;
}

const std::optional<HandleRange>& EditingSession::range() const {
  return implementation_->advice_.range;
}

const FoundDesigns& EditingSession::found() const {
  return implementation_->found_;
}

const std::optional<DirectionMap>& EditingSession::map() const {
  return implementation_->advice_.map;
}

const std::optional<HeightField>& EditingSession::envelopes() const {
  return implementation_->advice_.envelopes;
}

std::shared_ptr<const Design> EditingSession::design_of(int node) const {
  const History& history = implementation_->document_.project.history;
  expect_row(node, history.nodes.size(), "node");
  return implementation_->designs_.of(implementation_->workspace_->space(), history, node);
}

double EditingSession::f_max_of(int node) const {
  const std::shared_ptr<const Design> design = design_of(node);
  const HistoryNode& at = document().project.history.nodes[static_cast<std::size_t>(node)];
  return checker().measure(design->shape, Direction(at.direction)).f_max;
}

}  // namespace stackabilization::editing
