#include "stackabilization/improvement/improve.h"

#include <algorithm>
#include <utility>

#include "improvement/run/refinement_phase.h"
#include "improvement/run/work_budget.h"
#include "improvement/search/gap_descent.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/improvement/effort.h"

namespace stackabilization {

namespace {

using detail::RefinementPhase;
using detail::WorkBudget;

/// Shares of the work at which phases end, if refinement follows: the pursuits, the paper's search, the
/// search.
constexpr double pursuit_share = 0.4;
constexpr double paper_share = 0.45;
constexpr double search_share = 0.5;
/// Least share of the work for each search and for the diagnosis.
constexpr double min_search = 0.05;
/// Share of the work at which the diagnosis of a closed shape ends.
constexpr double closed_share = 0.1;

/// With smooth edits: few edits that a designer would name are worth some change, 3 % for each edit
/// less. Edits that give less than a quarter of the gain may be made up for by the others.
constexpr double edit_price = 0.03;
constexpr double drop_threshold = 0.25;

/// Gain of S below which a design that does not reach the target is no better than the shape at rest.
constexpr double min_gain = 0.005;

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
      if (result_.diagnosis) result_.diagnosis->closed = closed;
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
      search.solutions = std::max(search.solutions, detail::min_refined);
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

  /// Tells the caller of a design if it meets the requirements.
  void tell(const Candidate& candidate) const {
    if (options_.found && checker_.meets_target(candidate.measured) &&
        checker_.check(candidate.design, Direction(candidate.direction)).passed())
      options_.found(candidate);
  }

  /// Runs a pursuit along every starting direction and, where no edit by itself is worth it, one by overlaps.
  std::vector<Candidate> pursuits(const BestFirstOptions& search) {
    std::vector<Candidate> found;
    double first = 0;
    for (const Eigen::Vector3d& direction : search.directions) {
      Candidate start = at_rest(checker_, direction);
      if (found.empty()) first = start.measured.value;
      start.energy.gain = start.measured.value - first;
      start.energy.value = -(1 - search.alpha) * start.energy.gain;
      GapDescentResult result = pursuit(search, start, GapMeasure::equal);
      const bool stuck = result.stuck;
      found.push_back(std::move(result.candidate));
      if (!stuck) continue;
      result = pursuit(search, start, GapMeasure::by_overlap);
      if (!result.candidate.design.edits.empty()) found.push_back(std::move(result.candidate));
    }
    return found;
  }

  GapDescentResult pursuit(const BestFirstOptions& search, const Candidate& start, GapMeasure measure) {
    GapDescentOptions options;
    options.measure = measure;
    options.alpha = search.alpha;
    options.edits = search.edits;
    options.cancelled = [this] { return late(pursuit_share); };
    options.evaluations = budget_.designs_until(pursuit_share);
    GapDescentResult result = descend_gaps(checker_, start, options);
    budget_.charge(result.evaluations);
    result_.progress.evaluated += result.evaluations;
    result_.progress.best_stackability =
        std::max(result_.progress.best_stackability, result.candidate.measured.value);
    result_.progress.best_energy = std::min(result_.progress.best_energy, result.candidate.energy.value);
    report_progress();
    tell(result.candidate);
    return result;
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

  /// Reports the progress of a phase that is no search.
  void report_progress() const {
    if (!options_.search.progress) return;
    ImprovementProgress now = result_.progress;
    now.work = std::max(now.work, budget_.share_used());
    now.seconds_left = budget_.seconds_until(1);
    options_.search.progress(now);
  }

  /// Adds what the phases before this search came to.
  ImprovementProgress counted(ImprovementProgress now) const {
    now.expanded += result_.progress.expanded;
    now.evaluated += result_.progress.evaluated;
    now.best_stackability = std::max(now.best_stackability, result_.progress.best_stackability);
    now.best_energy = std::min(now.best_energy, result_.progress.best_energy);
    now.work = std::max(budget_.share_used(now.trials),
                        static_cast<double>(now.expanded) / static_cast<double>(options_.search.expansions));
    now.trials += result_.progress.trials;
    now.seconds_left = budget_.seconds_until(1);
    return now;
  }

  void refine(std::vector<Candidate> starts, BestFirstResult& found) {
    const std::int64_t others = result_.progress.evaluated - budget_.used();
    RefinementPhase phase(checker_, options_, budget_, [this, others] {
      result_.progress.evaluated = others + budget_.used();
      report_progress();
    });
    result_.solutions = phase.refined(std::move(starts), found);
    result_.progress.evaluated = others + budget_.used();
    if (phase.nearest()) found.nearest.insert(found.nearest.begin(), *phase.nearest());
    std::stable_sort(found.nearest.begin(), found.nearest.end(), detail::more_stackable);
    if (result_.solutions.size() >= static_cast<std::size_t>(options_.search.solutions) ||
        (!result_.solutions.empty() && found.solutions.empty() && result_.end == SearchEnd::exhausted))
      result_.end = SearchEnd::solved;
  }

  /// Leaves out what came near but breaks a limit of quality, or changes the shape for nothing. The shape at
  /// rest is always near.
  void keep_acceptable(std::vector<Candidate>& nearest) const {
    if (!refines_ || !checker_.requirements().quality) return;
    const auto first = std::find_if(nearest.begin(), nearest.end(), [this](const Candidate& candidate) {
      return !checker_.obstacle(candidate.design, Direction(candidate.direction));
    });
    nearest.erase(nearest.begin(), first);
    const Candidate rest =
        at_rest(checker_, nearest.empty() ? options_.search.directions.front() : nearest.front().direction);
    if (nearest.empty() || (!nearest.front().design.edits.empty() &&
                            nearest.front().measured.value < rest.measured.value + min_gain))
      nearest.insert(nearest.begin(), rest);
  }

  void finish(BestFirstResult found) {
    Eigen::Vector3d direction = options_.search.directions.front();
    if (result_.solutions.empty()) keep_acceptable(found.nearest);
    if (!result_.solutions.empty()) {
      direction = result_.solutions.front().direction;
    } else if (!found.nearest.empty()) {
      direction = found.nearest.front().direction;
      diagnose(found);
    }
    for (const Candidate& solution : result_.solutions)
      result_.assessments.push_back(checker_.check(solution.design, Direction(solution.direction)));
    result_.before = at_rest(checker_, direction);
    if (cancelled())
      result_.end = SearchEnd::cancelled;
    else if (budget_.met_deadline())
      result_.end = SearchEnd::time_limit;
  }

  /// Finds out what keeps the best design from the target, and which one is nearest. Where one more edit
  /// reaches the target, that is a solution.
  void diagnose(const BestFirstResult& found) {
    DiagnosisOptions options;
    options.designs = static_cast<double>(budget_.designs_until(diagnosis_end_, min_search));
    options.directions_per_design =
        static_cast<double>(directions_of_effort(1, checker_.space().rest().shape)) /
        designs_of_effort(1, checker_.rest_shape());
    options.cancelled = [this] { return late(1); };
    Diagnosis diagnosis = stackabilization::diagnose(checker_, found, options);
    if (diagnosis.better && checker_.meets_target(diagnosis.better->measured)) {
      tell(*diagnosis.better);
      result_.solutions.push_back(std::move(*diagnosis.better));
      return;
    }
    result_.nearest = diagnosis.better ? *diagnosis.better : found.nearest.front();
    result_.diagnosis = std::move(diagnosis);
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

ImprovementOptions improvement_options(const DeformationModel& space) {
  ImprovementOptions options;
  if (space.following() != Following::smooth) return options;
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
