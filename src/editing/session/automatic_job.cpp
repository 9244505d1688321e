// The automatic search: designs that reach the target, or a front.
#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "editing/session/session_implementation.h"
#include "improvement/design/distinct.h"
#include "stackabilization/improvement/front.h"

namespace stackabilization::editing {

namespace {

/// Efforts of the automatic search, fractions of the effort asked for: a first answer soon, then a better
/// one. Fronts are made of first answers.
constexpr std::array<double, 2> effort_shares = {0.1, 1};

/// Different designs that are looked for.
constexpr std::size_t wanted_designs = 3;

/// What a search has found so far, least change first: different designs that reach the target, or a front.
class FoundSoFar {
 public:
  FoundSoFar(const RequirementChecker& checker, FoundDesigns wanted)
      : rest_(checker.space().rest()), diversity_(rest_), found_(std::move(wanted)) {}

  const FoundDesigns& designs() const { return found_; }

  /// Adds a design. Returns false where others that are no different, or enough others, change less.
  bool add(const Candidate& candidate) {
    const Sized one = sized(candidate);
    std::vector<FoundDesign>& designs = found_.designs;
    for (std::size_t row = 0; row < designs.size(); ++row)
      if (!diversity_.differ(designs[row].candidate.design, candidate.design)) {
        if (sizes_[row] <= one.size) return false;
        erase(row);
        break;
      }
    if (designs.size() == wanted_designs) {
      if (sizes_.back() <= one.size) return false;
      erase(wanted_designs - 1);
    }
    insert(candidate, one);
    return true;
  }

  /// Adds a design of a front. Returns false where another one changes no more for no less S, and leaves out
  /// those of which this design says the same.
  bool add_to_front(const Candidate& candidate) {
    const Sized one = sized(candidate);
    const double s = candidate.measured.value;
    const auto s_of = [this](std::size_t row) { return found_.designs[row].candidate.measured.value; };
    for (std::size_t row = 0; row < sizes_.size(); ++row)
      if (sizes_[row] <= one.size && s_of(row) >= s) return false;
    for (std::size_t row = sizes_.size(); row-- > 0;)
      if (one.size <= sizes_[row] && s >= s_of(row)) erase(row);
    insert(candidate, one);
    return true;
  }

  /// Takes what a search has come to in the end.
  void settle(const Improvement& improvement) {
    clear();
    for (const Candidate& solution : improvement.solutions) add(solution);
    found_.diagnosis = improvement.diagnosis;
  }

  /// The same for a front, whose first point is at rest.
  void settle(const Front& front) {
    clear();
    for (std::size_t k = 1; k < front.points.size(); ++k) add_to_front(front.points[k].candidate);
    found_.diagnosis = front.diagnosis;
  }

 private:
  struct Sized {
    ShapeChange change;
    double size = 0;
  };

  Sized sized(const Candidate& candidate) const {
    const ShapeChange change = shape_change(rest_.shape, candidate.design.shape);
    return {change, size_of(ChangeMeasure::both, candidate.energy.distortion, change)};
  }

  void clear() {
    found_.designs.clear();
    sizes_.clear();
  }

  /// A design that comes again keeps its number.
  int number_of(const Points& vertices) {
    const auto known = std::find(numbered_.begin(), numbered_.end(), vertices);
    const auto number = known - numbered_.begin();
    if (known == numbered_.end()) numbered_.push_back(vertices);
    return static_cast<int>(number);
  }

  void insert(const Candidate& candidate, const Sized& one) {
    const auto place = std::upper_bound(sizes_.begin(), sizes_.end(), one.size) - sizes_.begin();
    const Design& design = candidate.design;
    sizes_.insert(sizes_.begin() + place, one.size);
    found_.designs.insert(
        found_.designs.begin() + place,
        {number_of(design.shape.vertices), candidate,
         explain(rest_, design.shape, {.edits = design.edits, .reasons = candidate.reasons}), one.change});
  }

  void erase(std::size_t row) {
    sizes_.erase(sizes_.begin() + static_cast<std::ptrdiff_t>(row));
    found_.designs.erase(found_.designs.begin() + static_cast<std::ptrdiff_t>(row));
  }

  const StructuredShape& rest_;
  detail::SolutionDiversity diversity_;
  FoundDesigns found_;
  std::vector<double> sizes_;     ///< of the changes
  std::vector<Points> numbered_;  ///< vertices of all designs that were ever shown, by their numbers
};

/// Returns the share of the whole search that is done, when a search of this effort has done `work` of its
/// own.
double work_done(double share, double work) {
  const double first = effort_shares.front();
  return std::min(share == first ? first * work : first + (1 - first) * work, 1.0);
}

/// What a search tells of, and what ends it.
struct SearchCallbacks {
  std::function<bool()> cancelled;
  std::function<void(double done)> progress;  ///< share of the whole search
  std::function<void()> renewed;              ///< there are other designs than before
};

ImprovementOptions search_options(const DeformationModel& space, const Direction& direction,
                                  const SessionOptions& options, const SearchCallbacks& callbacks) {
  ImprovementOptions how = improvement_options(space);
  how.search.alpha = options.alpha;
  how.search.solutions = static_cast<int>(wanted_designs);
  how.search.directions = {direction.vector()};
  how.search.cancelled = callbacks.cancelled;
  return how;
}

void find_designs(const RequirementChecker& checker, const ImprovementOptions& options, double effort,
                  const SearchCallbacks& callbacks, FoundSoFar& found) {
  std::vector<Candidate> starts;
  for (const double share : effort_shares) {
    ImprovementOptions how = options;
    how.effort = share * effort;
    how.starts = starts;
    how.search.progress = [&](const ImprovementProgress& now) {
      callbacks.progress(work_done(share, now.work));
    };
    how.found = [&](const Candidate& one) {
      if (found.add(one)) callbacks.renewed();
    };
    const Improvement improvement = improve(checker, how);
    starts = improvement.solutions;
    found.settle(improvement);
    callbacks.renewed();
  }
}

void find_front(const RequirementChecker& checker, const ImprovementOptions& options, double effort,
                const SearchCallbacks& callbacks, FoundSoFar& found) {
  FrontOptions how;
  how.improvement = options;
  how.improvement.effort = effort_shares.front() * effort;
  int before = 0, all = 1;  // runs
  how.progress = [&](int run, int runs) {
    before = run;
    all = runs;
  };
  how.improvement.search.progress = [&](const ImprovementProgress& now) {
    callbacks.progress((before + std::min(now.work, 1.0)) / all);
  };
  how.found = [&](const Candidate& one) {
    if (found.add_to_front(one)) callbacks.renewed();
  };
  found.settle(improvement_front(checker, how));
  callbacks.renewed();
}

}  // namespace

FoundDesigns designs_to_find(const RequirementChecker& checker, const Direction& direction,
                             const FindDesigns& command) {
  FoundDesigns found;
  found.target = command.front ? farthest_target : checker.requirements().target;
  if (!command.front) found.within = checker.requirements().length_limit;
  found.front = command.front;
  found.at_rest = checker.rest_shape().measure(direction).value;
  found.running = true;
  return found;
}

JobWork EditingSession::Implementation::automatic_work() {
  const std::optional<FindDesigns> wanted = std::exchange(finding_wanted_, std::nullopt);
  if (!wanted) return nullptr;
  return [this, wanted = *wanted, workspace = workspace_, direction = direction_, options = options_](
             const Cancelled& cancelled, const Deliver& deliver) {
    FoundSoFar found(workspace->checker(), designs_to_find(workspace->checker(), direction, wanted));
    SearchCallbacks callbacks;
    callbacks.cancelled = [&] { return cancelled->load(); };
    callbacks.progress = [&](double done) {
      deliver(unless(cancelled, [this, done] { emit(Progress{Work::designs, done}); }));
    };
    callbacks.renewed = [&] { deliver_found(found.designs(), cancelled, deliver); };
    const ImprovementOptions how = search_options(workspace->space(), direction, options, callbacks);
    if (wanted.front) {
      Requirements requirements = workspace->checker().requirements();
      requirements.target = farthest_target;
      requirements.length_limit.reset();
      const Workspace aimed(*workspace, requirements);
      find_front(aimed.checker(), how, options.effort, callbacks, found);
    } else {
      find_designs(workspace->checker(), how, options.effort, callbacks, found);
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
