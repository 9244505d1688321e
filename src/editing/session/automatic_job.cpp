// The automatic search for designs that reach the target.
#include <algorithm>
#include <array>
#include <utility>

#include "editing/session/session_implementation.h"

namespace stackabilization::editing {

namespace {

/// Efforts of the automatic search, fractions of the effort asked for: a first answer soon, then a better
/// one.
constexpr std::array<double, 2> effort_shares = {0.1, 1};

/// Returns the share of the whole search that is done, when a search of this effort has done `work` of its
/// own.
double work_done(double share, double work) {
  const double first = effort_shares.front();
  return std::min(share == first ? first * work : first + (1 - first) * work, 1.0);
}

}  // namespace

JobWork EditingSession::Implementation::automatic_work() {
  if (!std::exchange(finding_wanted_, false)) return nullptr;
  return [this, workspace = workspace_, direction = direction_, options = options_](
             const Cancelled& cancelled, const Deliver& deliver) {
    std::vector<Candidate> starts;
    for (const double share : effort_shares) {
      ImprovementOptions how = improvement_options(workspace->space());
      how.effort = share * options.effort;
      how.search.alpha = options.alpha;
      how.search.solutions = 3;
      how.search.directions = {direction.vector()};
      how.starts = starts;
      how.search.cancelled = [&] { return cancelled->load(); };
      how.search.progress = [&](const ImprovementProgress& progress) {
        const double done = work_done(share, progress.work);
        deliver(unless(cancelled, [this, done] { emit(Progress{Work::designs, done}); }));
      };
      const Improvement improvement = improve(workspace->checker(), how);
      starts = improvement.solutions;
      deliver_found(*workspace, improvement, cancelled, deliver);
    }
    deliver(unless(cancelled, [this] {
      found_.running = false;
      emit(Changed{Change::found});
      emit(Progress{Work::designs, 1});
    }));
  };
}

void EditingSession::Implementation::deliver_found(const Workspace& workspace, const Improvement& improvement,
                                                   const Cancelled& cancelled, const Deliver& deliver) {
  FoundDesigns found;
  found.target = workspace.checker().requirements().target;
  found.designs = improvement.solutions;
  found.diagnosis = improvement.diagnosis;
  found.running = true;
  for (const Candidate& one : found.designs) {
    found.explanations.push_back(explain(workspace.space().rest(), one.design.shape,
                                         {.edits = one.design.edits, .reasons = one.reasons}));
    found.changes.push_back(shape_change(workspace.space().rest().shape, one.design.shape));
  }
  deliver(unless(cancelled, [this, found] {
    found_ = found;
    emit(Changed{Change::found});
  }));
}

}  // namespace stackabilization::editing
