#include "editing/session/session_implementation.h"

#include <utility>

#include "stackabilization/core/errors.h"
#include "stackabilization/io/write_file.h"

namespace stackabilization::editing {

void expect_row(int row, std::size_t size, const std::string& what) {
  if (row < 0 || static_cast<std::size_t>(row) >= size)
    throw UsageError("there is no " + what + " " + std::to_string(row) + ", only " + std::to_string(size) +
                     " counted from 0");
}

void expect_usable(const Document& document, const SessionOptions& options) {
  if (options.max_suggestions < 1) throw UsageError("at least one suggestion has to be offered");
  if (document.project.history.nodes.empty() || document.visited.empty())
    throw UsageError("a document has at least the node at rest");
}

std::string node_name(const Explanation& change, const std::string& otherwise) {
  return change.groups.empty() ? otherwise : describe(change.groups.front(), change);
}

EditingSession::Implementation::Implementation(Document document, SessionOptions options, Listener listener)
    : document_(std::move(document)),
      options_(std::move(options)),
      listener_(std::move(listener)),
      lanes_([this](Lane lane, const std::string& sentence) {
        if (lane == Lane::automatic && !finding_wanted_) stop_finding();
        emit(Failed{sentence});
      }) {
  expect_usable(document_, options_);
  workspace_ = std::make_shared<const Workspace>(document_.project, document_.requirements);
  load_node();
}

std::optional<EditingSession::Job> EditingSession::Implementation::next_job(Lane lane) {
  if (lanes_.is_running(lane)) return std::nullopt;
  JobWork work;
  if (lane == Lane::automatic && map_wanted_)
    work = map_work();
  else if (lane == Lane::automatic)
    work = automatic_work();
  else if ((range_runs_ = wanted_range_.has_value()))
    work = range_work();
  else if (!drag_ && envelopes_wanted_)
    work = envelope_work();
  else if (!drag_ && !advice_.review)
    work = review_work();
  else if (!drag_ && !advice_.complete && options_.suggests)
    work = suggestion_work();
  if (!work) return std::nullopt;
  return lanes_.start(lane, std::move(work));
}

void EditingSession::Implementation::forget_advice() {
  lanes_.cancel(Lane::advice);
  advice_ = {};
  wanted_range_.reset();
  map_wanted_ = envelopes_wanted_ = false;
  drag_.reset();
}

void EditingSession::Implementation::load_node() {
  const HistoryNode& node = history().nodes[static_cast<std::size_t>(history().current)];
  std::shared_ptr<const Design> design =
      designs_.of(workspace_->space(), document_.project.history, history().current);
  direction_ = Direction(node.direction);
  at_rest_ = workspace_->checker().rest_shape().measure(direction_);
  current_ = workspace_->measured(std::move(design), direction_, at_rest_.value);
  forget_advice();
}

void EditingSession::Implementation::announce_node() {
  save();
  emit(Changed{Change::design});
  emit(Changed{Change::review});
  emit(Changed{Change::suggestions});
  emit(Changed{Change::range});
  emit(Changed{Change::tree});
}

void EditingSession::Implementation::save() {
  if (options_.autosave.empty()) return;
  unsaved_ = true;
  try {
    write_file_atomically(options_.autosave, document_text(document_));
    unsaved_ = false;
  } catch (const Error& error) {
    emit(Failed{error.what()});
  }
}

void EditingSession::Implementation::visit(int node) {
  history().current = node;
  document_.visited.resize(document_.place + 1);
  document_.visited.push_back(node);
  document_.place = document_.visited.size() - 1;
  load_node();
  announce_node();
}

void EditingSession::Implementation::go_to_place(std::size_t place) {
  document_.place = place;
  history().current = document_.visited[place];
  load_node();
  announce_node();
}

void EditingSession::Implementation::add_node(HistoryNode node, std::shared_ptr<const Design> design) {
  history() = apply(std::move(history()), std::move(node));
  designs_.remember(history().current, std::move(design));
  visit(history().current);
}

HistoryNode EditingSession::Implementation::node_with(std::vector<Edit> edits, std::string name) const {
  HistoryNode node;
  node.edits = std::move(edits);
  node.constraints = workspace_->constraints(direction_);
  node.name = std::move(name);
  node.direction = direction_.vector();
  return node;
}

}  // namespace stackabilization::editing
