#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "stackabilization/editing/session.h"

/// A study with people (after section 6 of the paper): tasks, how each of them is done, and what is written
/// down of it.
namespace stackabilization::editing {

/// How a task is done.
enum class StudyCondition {
  manual,      ///< with handles only
  suggestive,  ///< with handles and suggestions
  automatic,   ///< with the designs that the automatic search finds
};
/// "manual", "suggestive", "automatic".
std::string name_of(StudyCondition condition);
/// Says whether the condition allows a command; those that only look, go back or undo are always allowed.
bool allows(StudyCondition condition, const Command& command);

/// An object, and how well it is to stack.
struct StudyPlanTask {
  std::string name;                                      ///< as tables call it; not empty, each once
  std::string model;                                     ///< mesh or project file, relative to the plan
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< along which it is stacked
  double target = 0;                                     ///< S that is wanted
  std::vector<std::string> without;                      ///< names of parts that are left out
};

/// What a study asks of its participants.
struct StudyPlan {
  std::string consent;                   ///< text to which they agree first
  std::array<std::string, 3> questions;  ///< after each task, answered from 1, not at all, to 5, very much
  std::vector<StudyPlanTask> tasks;      ///< at least one
};

/// Reads a plan:
///
///     {"format": "stackabilize study", "version": 1, "consent": "...", "questions": ["...", "...", "..."],
///      "tasks": [{"name": "table", "model": "table.obj", "direction": [0, 0, 1], "target": 0.5,
///                 "without": ["middle_bar"]}]}
///
/// `consent`, `questions`, `direction` and `without` may be left out. Throws InputError naming `name` and the
/// place in the text where it is not as described.
StudyPlan study_plan_of_text(std::string_view text, const std::string& name);

/// A task of one participant.
struct StudyTurn {
  int task = 0;                                       ///< row of StudyPlan::tasks
  StudyCondition condition = StudyCondition::manual;  ///< how the task is done
};

/// Returns the turns of a participant, one per task. Over six participants in a row each task is done twice
/// in each condition, and within groups of three turns each condition follows each other one equally often
/// (Williams 1949). From one six to the next the tasks move on by one. Precondition: participant >= 1.
std::vector<StudyTurn> study_turns(int participant, int tasks);

/// What is written down when something happened.
struct StudyEntry {
  int participant = 1, turn = 1;                      ///< counted from 1
  std::string task;                                   ///< name of the task
  StudyCondition condition = StudyCondition::manual;  ///< how the task is done
  double seconds = 0;                                 ///< since the task was shown
  std::string event;                                  ///< "begin", "edit", "go", "done" or "give up"
  std::string edit;                 ///< of an edit: what was edited, as `deform --edit` reads it
  double target = 0;                ///< S that is wanted
  Assessment assessment;            ///< of the design then, with all checks that follow a drag
  Energy energy;                    ///< of the design then
  double change = 0;                ///< of the design then, root mean square over the diagonal
  int edits = 0;                    ///< from rest to the design
  std::array<int, 3> answers = {};  ///< of "done" and "give up", 1 to 5; 0: none
};

/// Returns the first row of the CSV, with a line end.
std::string study_heading();
/// Returns a row of the CSV, with a line end. There is nothing of a person in it but a number. `limits`:
/// those of quality, of which the nearest one is named.
std::string study_row(const StudyEntry& entry, const QualityLimits& limits);
/// What a participant came to in one task.
struct StudyResult {
  int participant = 1;                                ///< counted from 1
  std::string task;                                   ///< name of the task
  StudyCondition condition = StudyCondition::manual;  ///< how the task was done
  double seconds = 0;                                 ///< from the begin of the task to its end
  double target = 0, stackability = 0;                ///< S that was wanted, and of the design at the end
  bool reached = false;                               ///< whether all checks passed at the end
  Distortion distortion;                              ///< of the design at the end
  double change = 0;                                  ///< of the design at the end
  int edits = 0;                                      ///< from rest to the design at the end
  int made = 0;                     ///< edits that were made, also those that were given up later
  std::array<int, 3> answers = {};  ///< 1 to 5
};

/// Returns the results in a CSV of studies, in its order; tasks that were not ended are left out. Throws
/// InputError naming `name` and the line where it is not as `study_row` writes it.
std::vector<StudyResult> study_results(std::string_view csv, const std::string& name);

/// Returns the largest number of a participant in a CSV, 0 if there is none. Throws InputError naming `name`
/// and the line if it does not have the columns of `study_heading`.
int last_participant(std::string_view csv, const std::string& name);

}  // namespace stackabilization::editing
