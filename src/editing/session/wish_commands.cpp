// Commands that change what is wanted of designs.
#include <algorithm>
#include <utility>

#include "editing/session/session_implementation.h"
#include "stackabilization/core/direction_text.h"
#include "stackabilization/core/errors.h"

namespace stackabilization::editing {

void EditingSession::Implementation::require(const Requirements& requirements) {
  workspace_ = std::make_shared<const Workspace>(*workspace_, requirements);
  document_.requirements = requirements;
  stop_finding();
  load_node();
  emit(Changed{Change::wishes});
  announce_node();
}

void EditingSession::Implementation::run(const SetTarget& command) {
  Requirements requirements = document_.requirements;
  requirements.target = command.target;
  requirements.length_limit.reset();
  require(requirements);
}

void EditingSession::Implementation::run(const SetLengthLimit& command) {
  Requirements requirements = document_.requirements;
  requirements.target = target_within(command.limit, workspace_->checker().rest_shape(), direction_);
  requirements.length_limit = command.limit;
  require(requirements);
}

void EditingSession::Implementation::run(const SetLimit& command) {
  Requirements requirements = document_.requirements;
  if (!requirements.quality) requirements.quality.emplace();
  if (command.limit)
    (*requirements.quality)[command.measure] = *command.limit;
  else
    requirements.quality->relax(command.measure);
  require(requirements);
}

void EditingSession::Implementation::run(const KeepParts& command) {
  Requirements requirements = document_.requirements;
  requirements.kept_parts = command.parts;
  require(requirements);
}

void EditingSession::Implementation::run(const SetDirection& command) {
  const Direction direction(command.direction);
  const MeasuredDesign measured = workspace_->measured(
      current_.design, direction, workspace_->checker().rest_shape().measure(direction).value);
  HistoryNode node = node_with({}, "stacked " + direction_text(command.direction));
  node.constraints = workspace_->constraints(direction);
  node.direction = command.direction;
  node.stackability = measured.assessment.measured.value;
  node.energy = measured.energy.value;
  add_node(std::move(node), current_.design);
}

void EditingSession::Implementation::run(const FindDesigns& command) {
  lanes_.cancel(Lane::automatic);
  finding_wanted_ = command;
  found_ = designs_to_find(workspace_->checker(), direction_, command);
  emit(Changed{Change::found});
  emit(Progress{Work::designs, 0});
}

void EditingSession::Implementation::run(const StopFinding& /*command*/) {
  stop_finding();
}

void EditingSession::Implementation::stop_finding() {
  lanes_.cancel(Lane::automatic);
  finding_wanted_.reset();
  if (!std::exchange(found_.running, false)) return;
  emit(Changed{Change::found});
  emit(Progress{Work::designs, 1});
}

void EditingSession::Implementation::run(const AcceptRemedy& command) {
  const std::vector<Remedy> none;
  const std::optional<Diagnosis>& diagnosis =
      command.source == AcceptRemedy::Source::search ? found_.diagnosis : advice_.diagnosis;
  const std::vector<Remedy>& remedies = diagnosis ? diagnosis->remedies : none;
  expect_row(command.number, remedies.size(), "offer");
  const Remedy remedy = remedies[static_cast<std::size_t>(command.number)];
  Requirements requirements = document_.requirements;
  switch (remedy.kind) {
    case Remedy::Kind::other_direction:
      return run(SetDirection{remedy.direction});
    case Remedy::Kind::free_part:
      std::erase_if(requirements.kept_parts, [&](int part) {
        return std::find(remedy.parts.begin(), remedy.parts.end(), part) != remedy.parts.end();
      });
      break;
    case Remedy::Kind::remove_part:
    case Remedy::Kind::take_apart:
      return run(RemoveParts{remedy.parts});
    case Remedy::Kind::relax_height:
      requirements.keep_height = false;
      break;
    case Remedy::Kind::relax_box:
      requirements.box_tolerance.reset();
      break;
    case Remedy::Kind::relax_quality:
      if (requirements.quality) requirements.quality->relax(remedy.measure);
      break;
  }
  require(requirements);
}

void EditingSession::Implementation::run(const MapDirections& /*command*/) {
  if (!advice_.map) map_wanted_ = true;
}

void EditingSession::Implementation::run(const SampleEnvelopes& /*command*/) {
  if (advice_.envelopes || envelopes_wanted_) return;
  envelopes_wanted_ = true;
  if (!range_runs_) lanes_.cancel(Lane::advice);
}

}  // namespace stackabilization::editing
