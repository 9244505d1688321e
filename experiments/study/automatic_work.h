#pragma once

#include "stackabilization/improvement/improve.h"
#include "study/study_tasks.h"

namespace stackabilization::experiments {

/// What the automatic method came to.
struct AutomaticWork {
  Candidate result;  ///< the best solution, or what came nearest to one
  bool reached = false;
  std::int64_t tried = 0;  ///< designs made on the way, refused ones too
};

/// `improve` along the direction of the task, and no other, ended by its number of expansions and not by a
/// clock.
AutomaticWork automatic_work(const DeformationModel& space, const StudyTask& task,
                             const ImprovementOptions& options);

}  // namespace stackabilization::experiments
