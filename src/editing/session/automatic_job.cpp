// The automatic search for designs that reach the target.
#include <algorithm>
#include <array>
#include <utility>

#include "editing/session/session_implementation.h"
#include "improvement/design/distinct.h"

namespace stackabilization::editing {

namespace {

/// Efforts of the automatic search, fractions of the effort asked for: a first answer soon, then a better
/// one.
constexpr std::array<double, 2> effort_shares = {0.1, 1};

/// Different designs that are looked for.
constexpr std::size_t wanted_designs = 3;

/// What a search has found so far: different designs, least change first.
class FoundSoFar {
 public:
  explicit FoundSoFar(const RequirementChecker& checker) : rest_(checker.space().rest()), diversity_(rest_) {
    found_.target = checker.requirements().target;
    found_.within = checker.requirements().length_limit;
    found_.running = true;
  }

  const FoundDesigns& designs() const { return found_; }

  /// Adds a design. Returns false where others that are no different, or enough others, change less.
  bool add(const Candidate& one) {
    const ShapeChange change = shape_change(rest_.shape, one.design.shape);
    const double size = size_of(order, one.energy.distortion, change);
    for (std::size_t row = 0; row < sizes_.size(); ++row)
      if (!diversity_.differ(found_.designs[row].design, one.design)) {
        if (sizes_[row] <= size) return false;
        erase(row);
        break;
      }
    const auto place = std::upper_bound(sizes_.begin(), sizes_.end(), size) - sizes_.begin();
    if (static_cast<std::size_t>(place) == wanted_designs) return false;
    if (sizes_.size() == wanted_designs) erase(wanted_designs - 1);
    sizes_.insert(sizes_.begin() + place, size);
    found_.designs.insert(found_.designs.begin() + place, one);
    found_.explanations.insert(
        found_.explanations.begin() + place,
        explain(rest_, one.design.shape, {.edits = one.design.edits, .reasons = one.reasons}));
    found_.changes.insert(found_.changes.begin() + place, change);
    return true;
  }

  /// Takes what a search has come to in the end.
  void settle(const Improvement& improvement) {
    while (!sizes_.empty()) erase(sizes_.size() - 1);
    for (const Candidate& one : improvement.solutions) add(one);
    found_.diagnosis = improvement.diagnosis;
  }

 private:
  static constexpr ChangeMeasure order = ChangeMeasure::both;

  void erase(std::size_t row) {
    const auto place = static_cast<std::ptrdiff_t>(row);
    sizes_.erase(sizes_.begin() + place);
    found_.designs.erase(found_.designs.begin() + place);
    found_.explanations.erase(found_.explanations.begin() + place);
    found_.changes.erase(found_.changes.begin() + place);
  }

  const StructuredShape& rest_;
  detail::SolutionDiversity diversity_;
  FoundDesigns found_;
  std::vector<double> sizes_;  ///< of the changes
};

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
    FoundSoFar found(workspace->checker());
    std::vector<Candidate> starts;
    for (const double share : effort_shares) {
      ImprovementOptions how = improvement_options(workspace->space());
      how.effort = share * options.effort;
      how.search.alpha = options.alpha;
      how.search.solutions = static_cast<int>(wanted_designs);
      how.search.directions = {direction.vector()};
      how.starts = starts;
      how.search.cancelled = [&] { return cancelled->load(); };
      how.search.progress = [&](const ImprovementProgress& progress) {
        const double done = work_done(share, progress.work);
        deliver(unless(cancelled, [this, done] { emit(Progress{Work::designs, done}); }));
      };
      how.found = [&](const Candidate& one) {
        if (found.add(one)) deliver_found(found.designs(), cancelled, deliver);
      };
      const Improvement improvement = improve(workspace->checker(), how);
      starts = improvement.solutions;
      found.settle(improvement);
      deliver_found(found.designs(), cancelled, deliver);
    }
    deliver(unless(cancelled, [this] {
      found_.running = false;
      emit(Changed{Change::found});
      emit(Progress{Work::designs, 1});
    }));
  };
}

void EditingSession::Implementation::deliver_found(const FoundDesigns& designs, const Cancelled& cancelled,
                                                   const Deliver& deliver) {
  const auto shared = std::make_shared<const FoundDesigns>(designs);
  deliver(unless(cancelled, [this, shared] {
    found_ = *shared;
    emit(Changed{Change::found});
  }));
}

}  // namespace stackabilization::editing
