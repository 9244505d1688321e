#include "improvement/run/refinement_phase.h"

#include <algorithm>
#include <utility>

namespace stackabilization::detail {

namespace {

/// Share at which the refinement with the given edits ends and the one with added edits begins.
constexpr double first_share = 0.7;
/// Without a solution refinement ends at this share. The rest is for the diagnosis.
constexpr double diagnosis_begin = 0.85;

/// Largest number of designs measured to refine one list of edits.
constexpr int first_evaluations = 300;
/// So many solutions more than wanted are refined with added edits.
constexpr std::size_t more_extended = 4;

}  // namespace

bool more_stackable(const Candidate& a, const Candidate& b) {
  return a.measured.value > b.measured.value;
}

RefinementPhase::RefinementPhase(const RequirementChecker& checker, const ImprovementOptions& options,
                                 WorkBudget& budget, std::function<void()> report)
    : checker_(checker),
      options_(options.refinement),
      wanted_(static_cast<std::size_t>(options.search.solutions)),
      budget_(budget),
      report_(std::move(report)),
      found_(options.found),
      share_(diagnosis_begin),
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

std::vector<Candidate> RefinementPhase::refined(std::vector<Candidate> starts, const BestFirstResult& found) {
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
    if (solutions_.size() >= std::max<std::size_t>(wanted_, min_refined) || at_end()) break;
    add(near);
    starts.push_back(near);
  }
  if (checker_.requirements().quality) rescue(starts);
  extend();
  return std::move(solutions_);
}

/// Returns whether the current step has no work left.
bool RefinementPhase::at_end() const {
  return budget_.designs_until(share_) < min_refinement_evaluations || options_.cancelled();
}

RefinementResult RefinementPhase::refinement(const Candidate& start, RefinementOptions options) {
  options.evaluations =
      static_cast<int>(std::min<std::int64_t>(options.evaluations, budget_.designs_until(share_)));
  RefinementResult result = refine_candidate(checker_, start, options);
  budget_.charge(result.evaluations);
  report_();
  if (result.reached && found_) found_(result.candidate);
  return result;
}

/// Returns `start` checked, without refinement.
RefinementResult RefinementPhase::as_it_is(const Candidate& start) const {
  const bool reached = checker_.meets_target(start.measured) &&
                       checker_.check(start.design, Direction(start.direction)).passed();
  return {start, reached, 0};
}

void RefinementPhase::add(const Candidate& start) {
  if (start.design.edits.empty() && !checker_.meets_target(start.measured)) return;
  RefinementOptions alone = options_;
  alone.max_added_edits = 0;
  alone.evaluations = std::min(options_.evaluations, first_evaluations);
  RefinementResult result = at_end() ? as_it_is(start) : refinement(start, alone);
  if (result.reached) {
    share_ = first_share;
    keep(std::move(result.candidate));
  } else {
    note_nearest(std::move(result.candidate));
  }
}

/// Without a solution: refines the starts with added edits, until one reaches the target.
void RefinementPhase::rescue(const std::vector<Candidate>& starts) {
  for (const Candidate& start : starts) {
    if (!solutions_.empty() || at_end()) return;
    RefinementOptions all = options_;
    all.reach_with_added = true;
    RefinementResult result = refinement(start, all);
    if (result.reached)
      keep(std::move(result.candidate));
    else
      note_nearest(std::move(result.candidate));
  }
}

/// Refines with added edits, solutions of least change first.
void RefinementPhase::extend() {
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
void RefinementPhase::keep(Candidate candidate) {
  for (Candidate& other : solutions_)
    if (!distinct_.differ(other.design, candidate.design)) {
      if (less_changed_(candidate, other)) other = std::move(candidate);
      return;
    }
  solutions_.push_back(std::move(candidate));
}

void RefinementPhase::note_nearest(Candidate candidate) {
  if (nearest_ && !more_stackable(candidate, *nearest_)) return;
  if (checker_.requirements().quality && checker_.obstacle(candidate.design, Direction(candidate.direction)))
    return;
  nearest_ = std::move(candidate);
}

}  // namespace stackabilization::detail
