#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "apps/common/json.h"
#include "stackabilization/editing/study.h"

namespace stackabilization::apps {

struct StudyOptions {
  editing::StudyPlan plan;
  int participant = 1;            ///< counted from 1
  std::filesystem::path results;  ///< CSV to which rows are appended
  /// Makes the document of a task: its shape, direction and target.
  std::function<editing::Document(const editing::StudyPlanTask&)> open;
};

/// Leads one participant through the tasks of a study, and writes down what happens. Lives on the thread of
/// the session.
class StudyDesk {
 public:
  explicit StudyDesk(StudyOptions options);

  /// {type: "study", phase: "consent" | "task" | "questions" | "done", ...}
  Json state() const;
  /// Throws UsageError for a command that the task does not allow, or while no task is done.
  void check(const editing::Command& command) const;
  /// Obeys {"do": "study", "step": "agree" | "done" | "give up" | "answers", "answers": [1, 2, 3]}. Throws
  /// UsageError where that step does not come next, and OutputError when a row cannot be written.
  void step(const Json& command, editing::EditingSession& session);
  /// Writes down that the session shows another node.
  void note(const editing::EditingSession& session);

 private:
  enum class Phase { consent, task, questions, done };

  const editing::StudyTurn& turn() const { return turns_[static_cast<std::size_t>(turn_)]; }
  const editing::StudyPlanTask& task() const {
    return options_.plan.tasks[static_cast<std::size_t>(turn().task)];
  }
  void begin_task(editing::EditingSession& session);
  editing::StudyEntry entry(const editing::EditingSession& session, const std::string& event) const;
  void append(const std::string& text) const;

  StudyOptions options_;
  std::vector<editing::StudyTurn> turns_;
  Phase phase_ = Phase::consent;
  int turn_ = 0;
  std::chrono::steady_clock::time_point begin_;
  int nodes_ = 0;              ///< of the history, when the last row was written
  editing::StudyEntry ended_;  ///< the task that waits for its answers
  QualityLimits limits_;
};

}  // namespace stackabilization::apps
