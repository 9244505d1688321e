#include "stackabilization/improvement/improve.h"

#include <algorithm>
#include <utility>

#include "improvement/design/distinct.h"
#include "improvement/run/work_budget.h"
#include "improvement/search/gap_descent.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/improvement/effort.h"

namespace stackabilization {

namespace {

using detail::WorkBudget;

/// Shares of the work at which phases end, if refinement follows: the pursuits, the paper's search, the
/// search.
constexpr double pursuit_share = 0.4;
constexpr double paper_share = 0.45;
constexpr double search_share = 0.5;
/// Share at which the refinement with the given edits ends and the one with added edits begins.
constexpr double first_share = 0.7;
/// Least share of the work for each search and for the diagnosis.
constexpr double min_search = 0.05;
/// Without a solution refinement ends at this share. The rest is for the diagnosis.
constexpr double diagnosis_begin = 0.85;
/// Share of the work at which the diagnosis of a closed shape ends.
constexpr double closed_share = 0.1;

/// Largest number of designs measured to refine one list of edits.
constexpr int first_evaluations = 300;

/// The best solution is not known before refinement. So at least min_solutions are searched, and
/// more_extended solutions more than wanted are refined with added edits.
constexpr int min_solutions = 3;
constexpr std::size_t more_extended = 4;

/// Of smooth improvements: few edits that a designer would name are worth some change, 3 % for each edit
/// less. Edits that give less than a quarter of the gain may be made up for by the others.
constexpr double edit_price = 0.03;
constexpr double drop_threshold = 0.25;

/// Gain of S below which a design that does not reach the target is no better than the shape at rest.
constexpr double min_gain = 0.005;

bool more_stackable(const Candidate& a, const Candidate& b) {
  return a.measured.value > b.measured.value;
}

/// Refines the results of a search: first all of them with the given edits, then the best ones with added
/// edits, until there are as many different solutions as wanted.
class Refinements {
 public:
  /// `report`: called after each refinement.
  Refinements(const RequirementChecker& checker, const ImprovementOptions& options, WorkBudget& budget,
              std::function<void()> report)
      : checker_(checker),
        options_(options.refinement),
        wanted_(static_cast<std::size_t>(options.search.solutions)),
        budget_(budget),
        report_(std::move(report)),
        found_(options.found),
        less_changed_([measure = options.refinement.objective, &rest = checker.space().rest().shape](
                          const Candidate& a, const Candidate& b) {
          return size_of(measure, a, rest) < size_of(measure, b, rest);
        }),
        distinct_(checker.space().rest()) {
    options_.alpha = options.search.alpha;
    options_.family = options.search.edits.family;
    options_.cancelled = [this, cancelled = options.search.cancelled] {
      return budget_.late(share_) || (cancelled && cancelled());
    };
  }
  Refinements(const Refinements&) = delete;
  Refinements& operator=(const Refinements&) = delete;

  /// Refines `starts` (results of other phases) and the results of the search. Begins with candidates that
  /// reach the target, least change first, since the work may run out.
  std::vector<Candidate> refined(std::vector<Candidate> starts, const BestFirstResult& found) {
    starts.insert(starts.end(), found.solutions.begin(), found.solutions.end());
    const double target = checker_.requirements().target;
    std::stable_sort(starts.begin(), starts.end(), [this, target](const Candidate& a, const Candidate& b) {
      const bool reached = a.measured.value >= target;
      if (reached != (b.measured.value >= target)) return reached;
      return reached ? less_changed_(a, b) : more_stackable(a, b);
    });
    share_ = diagnosis_begin;
    for (const Candidate& start : starts) add(start);
    for (const Candidate& near : found.nearest) {
      if (solutions_.size() >= std::max<std::size_t>(wanted_, min_solutions) || at_end()) break;
      add(near);
      starts.push_back(near);
    }
    if (checker_.requirements().quality) rescue(starts);
    extend();
    return std::move(solutions_);
  }

  const std::optional<Candidate>& nearest() const { return nearest_; }

 private:
  /// Returns whether the current phase has no work left.
  bool at_end() const {
    return budget_.designs_until(share_) < min_refinement_evaluations || options_.cancelled();
  }

  RefinementResult refinement(const Candidate& start, RefinementOptions options) {
    options.evaluations =
        static_cast<int>(std::min<std::int64_t>(options.evaluations, budget_.designs_until(share_)));
    RefinementResult result = refine_candidate(checker_, start, options);
    budget_.charge(result.evaluations);
    report_();
    if (result.reached && found_) found_(result.candidate);
    return result;
  }

  void add(const Candidate& start) {
    if (start.design.edits.empty() && !checker_.meets_target(start.measured)) return;
    RefinementOptions alone = options_;
    alone.max_added_edits = 0;
    alone.evaluations = std::min(options_.evaluations, first_evaluations);
    RefinementResult result = at_end() ? as_it_is(start) : refinement(start, alone);
    if (result.reached) {
      share_ = first_share;
      keep(std::move(result.candidate));
    } else if (!nearest_ || result.candidate.measured.value > nearest_->measured.value) {
      nearest_ = std::move(result.candidate);
    }
  }

  /// Without a solution: refines the starts with added edits, until one reaches the target.
  void rescue(const std::vector<Candidate>& starts) {
    for (const Candidate& start : starts) {
      if (!solutions_.empty() || at_end()) return;
      RefinementOptions all = options_;
      all.reach_with_added = true;
      RefinementResult result = refinement(start, all);
      if (result.reached)
        keep(std::move(result.candidate));
      else if (!nearest_ || result.candidate.measured.value > nearest_->measured.value)
        nearest_ = std::move(result.candidate);
    }
  }

  /// Returns `start` checked, without refinement.
  RefinementResult as_it_is(const Candidate& start) const {
    const bool reached = checker_.meets_target(start.measured) &&
                         checker_.check(start.design, Direction(start.direction)).passed();
    return {start, reached, 0};
  }

  /// Refines with added edits, solutions of least change first.
  void extend() {
    share_ = 1;
    std::stable_sort(solutions_.begin(), solutions_.end(), less_changed_);
    std::vector<Candidate> found;
    found.swap(solutions_);
    for (std::size_t k = 0; k < found.size(); ++k) {
      if (k < wanted_ + more_extended && !at_end()) found[k] = refinement(found[k], options_).candidate;
      keep(std::move(found[k]));
    }
    std::stable_sort(solutions_.begin(), solutions_.end(), less_changed_);
    if (solutions_.size() > wanted_) solutions_.resize(wanted_);
  }

  /// Adds a solution. Of two solutions that are not different, the one of smaller change is kept.
  void keep(Candidate candidate) {
    for (Candidate& other : solutions_)
      if (!distinct_.differ(other.design, candidate.design)) {
        if (less_changed_(candidate, other)) other = std::move(candidate);
        return;
      }
    solutions_.push_back(std::move(candidate));
  }

  const RequirementChecker& checker_;
  RefinementOptions options_;
  std::size_t wanted_;
  WorkBudget& budget_;
  std::function<void()> report_;
  std::function<void(const Candidate&)> found_;
  double share_ = diagnosis_begin;  ///< share of the work at which the current phase ends
  std::function<bool(const Candidate&, const Candidate&)> less_changed_;
  detail::SolutionDiversity distinct_;
  std::vector<Candidate> solutions_;
  std::optional<Candidate> nearest_;
};

Candidate at_rest(const RequirementChecker& checker, const Eigen::Vector3d& direction) {
  Candidate rest;
  rest.design = checker.space().at_rest();
  rest.direction = direction;
  rest.measured = checker.rest_shape().measure(Direction(direction));
  return rest;
}

/// A run of `improve`, phase by phase.
class ImprovementRun {
 public:
  ImprovementRun(const RequirementChecker& checker, const ImprovementOptions& options,
                 const std::optional<SavedSearch>& state)
      : checker_(checker),
        options_(options),
        state_(state),
        refines_(options.preset == ImprovementPreset::refined),
        budget_(designs_of_effort(options.effort, checker.rest_shape()), options.search.seconds) {
    if (options.search.expansions < 1) throw UsageError("an improvement expands one candidate at least");
  }

  Improvement run() {
    const BestFirstOptions search = search_options();
    if (const std::optional<ClosedPair> closed = closed_shape()) {
      BestFirstResult nothing;
      nothing.nearest.push_back(at_rest(checker_, options_.search.directions.front()));
      diagnosis_end_ = closed_share;
      finish(nothing);
      result_.diagnosis->closed = closed;
      return std::move(result_);
    }
    if (!state_ && search.save) search.save(search_at_start(checker_, search));
    std::vector<Candidate> starts = options_.starts;
    if (refines_)
      for (Candidate& found : pursuits(search)) starts.push_back(std::move(found));
    if (refines_ && !checker_.requirements().quality) {
      BestFirstOptions paper = search;
      paper.edits.family = EditFamily::paper;
      paper.save = {};
      for (Candidate& solution : searched(paper, paper_share, std::nullopt).solutions)
        starts.push_back(std::move(solution));
    }
    BestFirstResult found = searched(search, refines_ ? search_share : 1, state_);
    result_.end = found.end;
    if (refines_)
      refine(std::move(starts), found);
    else
      result_.solutions = found.solutions;
    finish(found);
    return std::move(result_);
  }

 private:
  BestFirstOptions search_options() const {
    BestFirstOptions search = options_.search;
    if (refines_)
      search.solutions = std::max(search.solutions, min_solutions);
    else
      search.edits.family = EditFamily::paper;
    return search;
  }

  /// Returns what closes the shape to copies of itself along every starting direction, where limits of
  /// quality and the height are kept: then there is nothing to search for.
  std::optional<ClosedPair> closed_shape() const {
    const Requirements& asked = checker_.requirements();
    if (!refines_ || !asked.quality || !asked.keep_height || state_) return std::nullopt;
    std::optional<ClosedPair> first;
    for (const Eigen::Vector3d& r : options_.search.directions) {
      const Direction direction(r);
      const Stackability rest = checker_.rest_shape().measure(direction);
      const auto pair = closed_pair(checker_.rest_shape().shape(), direction, rest, asked.target);
      if (!pair || pair->stackability >= asked.target) return std::nullopt;
      if (!first) first = pair;
    }
    return first;
  }

  bool late(double share) { return budget_.late(share) || cancelled(); }
  bool cancelled() const { return options_.search.cancelled && options_.search.cancelled(); }

  /// Runs a pursuit along every starting direction.
  std::vector<Candidate> pursuits(const BestFirstOptions& search) {
    GapDescentOptions options;
    options.alpha = search.alpha;
    options.edits = search.edits;
    options.cancelled = [this] { return late(pursuit_share); };
    std::vector<Candidate> found;
    double first = 0;
    for (const Eigen::Vector3d& direction : search.directions) {
      Candidate start = at_rest(checker_, direction);
      if (found.empty()) first = start.measured.value;
      start.energy.gain = start.measured.value - first;
      start.energy.value = -(1 - search.alpha) * start.energy.gain;
      options.evaluations = budget_.designs_until(pursuit_share);
      GapDescentResult result = descend_gaps(checker_, start, options);
      budget_.charge(result.evaluations);
      result_.progress.evaluated += result.evaluations;
      found.push_back(std::move(result.candidate));
    }
    return found;
  }

  /// Runs a search until `share` of the work is used, with the expansions that are left. Work of a saved
  /// state counts as used.
  BestFirstResult searched(BestFirstOptions search, double share, const std::optional<SavedSearch>& state) {
    search.expansions -= result_.progress.expanded;
    search.trials = budget_.designs_until(share, min_search);
    search.seconds = budget_.seconds_until(share, min_search);
    if (search.progress)
      search.progress = [this, report = search.progress](ImprovementProgress now) { report(counted(now)); };
    BestFirstResult found =
        state ? resume_best_first(checker_, search, *state) : best_first(checker_, search);
    if (found.end == SearchEnd::time_limit) budget_.note_deadline();
    result_.progress = counted(found.progress);
    budget_.charge(found.progress.trials);
    if (options_.found)
      for (const Candidate& solution : found.solutions) options_.found(solution);
    return found;
  }

  /// Adds the counts of the phases before this search.
  ImprovementProgress counted(ImprovementProgress now) const {
    now.expanded += result_.progress.expanded;
    now.evaluated += result_.progress.evaluated;
    now.work = std::max(budget_.share_used(now.trials),
                        static_cast<double>(now.expanded) / static_cast<double>(options_.search.expansions));
    now.trials += result_.progress.trials;
    now.seconds_left = budget_.seconds_until(1);
    return now;
  }

  void refine(std::vector<Candidate> starts, BestFirstResult& found) {
    const std::int64_t before = budget_.used();
    Refinements refinements(checker_, options_, budget_, [this, before] {
      if (!options_.search.progress) return;
      ImprovementProgress now = result_.progress;
      now.evaluated += budget_.used() - before;
      now.work = std::max(now.work, budget_.share_used());
      now.seconds_left = budget_.seconds_until(1);
      options_.search.progress(now);
    });
    result_.solutions = refinements.refined(std::move(starts), found);
    result_.progress.evaluated += budget_.used() - before;
    if (refinements.nearest()) found.nearest.insert(found.nearest.begin(), *refinements.nearest());
    std::stable_sort(found.nearest.begin(), found.nearest.end(), more_stackable);
    if (result_.solutions.size() >= static_cast<std::size_t>(options_.search.solutions) ||
        (!result_.solutions.empty() && found.solutions.empty() && result_.end == SearchEnd::exhausted))
      result_.end = SearchEnd::solved;
  }

  /// Returns whether a design holds all that is asked but the target.
  bool is_acceptable(const Candidate& candidate) const {
    const Assessment assessment = checker_.check(candidate.design, Direction(candidate.direction));
    return std::all_of(assessment.checks.begin(), assessment.checks.end(), [](const Check& check) {
      return check.passed || check.kind == CheckKind::target || check.kind == CheckKind::room;
    });
  }

  /// Leaves out what came near but breaks a limit of quality, or changes the shape for nothing. The shape at
  /// rest is always near.
  void keep_acceptable(std::vector<Candidate>& nearest) const {
    if (!refines_ || !checker_.requirements().quality) return;
    const auto first = std::find_if(nearest.begin(), nearest.end(),
                                    [this](const Candidate& candidate) { return is_acceptable(candidate); });
    nearest.erase(nearest.begin(), first);
    const Candidate rest =
        at_rest(checker_, nearest.empty() ? options_.search.directions.front() : nearest.front().direction);
    if (nearest.empty() || (!nearest.front().design.edits.empty() &&
                            nearest.front().measured.value < rest.measured.value + min_gain))
      nearest.insert(nearest.begin(), rest);
  }

  void finish(BestFirstResult found) {
    for (const Candidate& solution : result_.solutions)
      result_.assessments.push_back(checker_.check(solution.design, Direction(solution.direction)));
    Eigen::Vector3d direction = options_.search.directions.front();
    if (result_.solutions.empty()) keep_acceptable(found.nearest);
    if (!result_.solutions.empty()) {
      direction = result_.solutions.front().direction;
    } else if (!found.nearest.empty()) {
      direction = found.nearest.front().direction;
      diagnose(found);
      result_.nearest = found.nearest.front();
      if (result_.diagnosis->better) result_.nearest = result_.diagnosis->better;
    }
    result_.before = at_rest(checker_, direction);
    if (cancelled())
      result_.end = SearchEnd::cancelled;
    else if (budget_.met_deadline())
      result_.end = SearchEnd::time_limit;
  }

  void diagnose(const BestFirstResult& found) {
    DiagnosisOptions options;
    options.designs = static_cast<double>(budget_.designs_until(diagnosis_end_, min_search));
    options.directions_per_design =
        static_cast<double>(directions_of_effort(1, checker_.space().rest().shape)) /
        designs_of_effort(1, checker_.rest_shape());
    options.cancelled = [this] { return late(1); };
    result_.diagnosis = stackabilization::diagnose(checker_, found, options);
  }

  const RequirementChecker& checker_;
  const ImprovementOptions& options_;
  const std::optional<SavedSearch>& state_;
  bool refines_;
  WorkBudget budget_;
  double diagnosis_end_ = 1;  ///< share of the work at which the diagnosis ends
  Improvement result_;
};

}  // namespace

ImprovementOptions smooth_improvement() {
  ImprovementOptions options;
  options.search.edits.family = EditFamily::smooth;
  options.refinement.edit_price = edit_price;
  options.refinement.drop_threshold = drop_threshold;
  return options;
}

Improvement improve(const RequirementChecker& checker, const ImprovementOptions& options,
                    const std::optional<SavedSearch>& state) {
  return ImprovementRun(checker, options, state).run();
}

}  // namespace stackabilization
