#include "study/automatic_work.h"

#include <atomic>
#include <limits>

namespace stackabilization::experiments {

namespace {

/// Counts the designs that are made of another space.
class CountedSpace : public DeformationModel {
 public:
  explicit CountedSpace(const DeformationModel& space) : space_(space) {}

  std::int64_t made() const { return made_; }

  const StructuredShape& rest() const override { return space_.rest(); }
  DeformationKind kind() const override { return space_.kind(); }
  std::vector<Handle> handles() const override { return space_.handles(); }
  Eigen::Vector3d centre(const Handle& handle) const override { return space_.centre(handle); }

  DeformationResult edited(const Design& now, const Edit& edit,
                           const DeformationConstraints& constraints) const override {
    ++made_;
    return space_.edited(now, edit, constraints);
  }

  DeformationResult deformed(const std::vector<Edit>& edits,
                             const DeformationConstraints& constraints) const override {
    ++made_;
    return space_.deformed(edits, constraints);
  }

 private:
  const DeformationModel& space_;
  mutable std::atomic<std::int64_t> made_ = 0;
};

}  // namespace

AutomaticWork automatic_work(const DeformationModel& space, const StudyTask& task,
                             const ImprovementOptions& options) {
  ImprovementOptions limited = options;
  limited.effort = std::numeric_limits<double>::infinity();
  limited.search.directions = {task.direction};
  const CountedSpace counted(space);
  Improvement found = improve(RequirementChecker(counted, task.requirements), limited);
  const bool reached = !found.solutions.empty();
  Candidate& best = reached ? found.solutions.front() : found.nearest ? *found.nearest : found.before;
  return {std::move(best), reached, counted.made()};
}

}  // namespace stackabilization::experiments
