#include "apps/editor/study_desk.h"

#include <fstream>
#include <utility>

#include "apps/common/edit_grammar.h"
#include "stackabilization/core/errors.h"

namespace stackabilization::apps {

using editing::EditingSession, editing::StudyEntry;

StudyDesk::StudyDesk(StudyOptions options)
    : options_(std::move(options)),
      turns_(editing::study_turns(options_.participant, static_cast<int>(options_.plan.tasks.size()))) {}

Json StudyDesk::state() const {
  Json json = {{"type", "study"}};
  switch (phase_) {
    case Phase::consent:
      json.update({{"phase", "consent"}, {"consent", options_.plan.consent}});
      break;
    case Phase::task:
      json.update({{"phase", "task"},
                   {"turn", turn_ + 1},
                   {"turns", turns_.size()},
                   {"task", task().name},
                   {"condition", name_of(turn().condition)},
                   {"target", task().target}});
      break;
    case Phase::questions:
      json.update({{"phase", "questions"}, {"questions", options_.plan.questions}});
      break;
    case Phase::done:
      json["phase"] = "done";
      break;
  }
  return json;
}

void StudyDesk::check(const editing::Command& command) const {
  if (phase_ != Phase::task) throw UsageError("no task has begun");
  if (!allows(turn().condition, command))
    throw UsageError("this task is done in the " + name_of(turn().condition) + " way");
}

void StudyDesk::step(const Json& command, EditingSession& session) {
  const Json step = command.value("step", Json());
  if (phase_ == Phase::consent && step == "agree") {
    if (!std::filesystem::exists(options_.results)) append(editing::study_heading());
    return begin_task(session);
  }
  if (phase_ == Phase::task && (step == "done" || step == "give up")) {
    if (session.dragging()) session.execute(editing::EndDrag{false});
    ended_ = entry(session, step.get<std::string>());
    phase_ = Phase::questions;
    return;
  }
  if (phase_ != Phase::questions || step != "answers")
    throw UsageError("this step of the study does not come next");
  const Json answers = command.value("answers", Json());
  StudyEntry row = ended_;
  if (!answers.is_array() || answers.size() != row.answers.size())
    throw UsageError("'answers' of the command expects three numbers");
  for (std::size_t k = 0; k < row.answers.size(); ++k) {
    const auto answer = answers[k].is_number_integer() ? answers[k].get<std::int64_t>() : 0;
    if (answer < 1 || answer > 5) throw UsageError("an answer is a number from 1 to 5");
    row.answers[k] = static_cast<int>(answer);
  }
  append(study_row(row, limits_));
  if (++turn_ == static_cast<int>(turns_.size())) {
    phase_ = Phase::done;
    return;
  }
  begin_task(session);
}

void StudyDesk::begin_task(EditingSession& session) {
  phase_ = Phase::consent;  // while the task is opened, nothing is written down
  editing::SessionOptions options;
  options.suggests = turn().condition == editing::StudyCondition::suggestive;
  session.open(options_.open(task()), options);
  limits_ = session.checker().requirements().quality.value_or(QualityLimits());
  begin_ = std::chrono::steady_clock::now();
  nodes_ = static_cast<int>(session.document().project.history.nodes.size());
  append(study_row(entry(session, "begin"), limits_));
  phase_ = Phase::task;  // now that it is written down; where it cannot be, a person may agree again
}

void StudyDesk::note(const EditingSession& session) {
  if (phase_ != Phase::task) return;
  const History& history = session.document().project.history;
  const auto nodes = static_cast<int>(history.nodes.size());
  StudyEntry row = entry(session, nodes > nodes_ ? "edit" : "go");
  if (nodes > nodes_) {
    const std::vector<std::string>& names = session.space().rest().shape.part_names;
    for (const Edit& edit : history.nodes.back().edits)
      row.edit += (row.edit.empty() ? "" : "; ") + edit_text(edit, names);
  }
  nodes_ = nodes;
  append(study_row(row, limits_));
}

StudyEntry StudyDesk::entry(const EditingSession& session, const std::string& event) const {
  StudyEntry row;
  row.participant = options_.participant;
  row.turn = turn_ + 1;
  row.task = task().name;
  row.condition = turn().condition;
  row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  row.event = event;
  row.target = task().target;
  row.assessment = session.current().assessment;
  row.energy = session.current().energy;
  row.change = session.current().change.root_mean_square;
  row.edits = static_cast<int>(session.current().design->edits.size());
  return row;
}

void StudyDesk::append(const std::string& text) const {
  std::ofstream file(options_.results, std::ios::binary | std::ios::app);
  file << text << std::flush;
  if (!file) throw OutputError(options_.results.string() + " cannot be written");
}

}  // namespace stackabilization::apps
