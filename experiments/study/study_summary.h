#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/experiment.h"
#include "stackabilization/improvement/energy.h"

namespace stackabilization::experiments {

/// One user, or one preset of the automatic method, at one task.
struct StudyRun {
  std::string task, model, input_hash, user;
  std::optional<std::int64_t> seed;  ///< of a simulated user; of people the number of the participant
  double target = 0, before = 0;     ///< S asked for, and at rest
  bool reached = false;              ///< the target, all requirements held
  double stackability = 0;           ///< at the end
  Energy energy;                     ///< against rest
  double change = 0;                 ///< root mean square of the vertices, over the diagonal
  std::int64_t kept = 0, tried = 0;  ///< edits
  double processor_seconds = 0;      ///< of the machine; of simulated users their mean
};

/// `user` of the runs with which the others are compared.
inline constexpr const char* refined_user = "automatic, refined";

/// Tables of the runs ("") and of their medians and quartiles ("summary"), the latter per task and over all
/// tasks, where S stands as the part of the way to the target; plots of D against S ("") and of targets
/// reached against edits tried ("edits"). `refined_beats_D`: the share of the runs that missed a target which
/// the refined preset reached, or reached it with more D; where both missed it, with less S. The same for the
/// root mean square change. Users and tasks in the order in which they first occur. Precondition: every task
/// has a run of the refined preset.
void report_study(const std::vector<StudyRun>& runs, Report& report);

}  // namespace stackabilization::experiments
