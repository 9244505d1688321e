#include "stackabilization/improvement/improve.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "stackabilization/improvement/distinct.h"

namespace stackabilization {

namespace {

using Clock = std::chrono::steady_clock;

/// Share of the time that the search may take where its results are refined afterwards.
constexpr double search_share = 0.6;

BestFirstOptions search_options(const ImprovementOptions& options) {
  BestFirstOptions search = options.search;
  if (options.preset == ImprovementPreset::paper)
    search.edits.family = EditFamily::paper;
  else
    search.seconds *= search_share;
  return search;
}

bool less_energy(const Candidate& a, const Candidate& b) {
  return a.energy.value < b.energy.value;
}

/// Refines what a search found until there are as many different solutions as wanted.
class Refiner {
 public:
  Refiner(const RequirementChecker& checker, const ImprovementOptions& options, Clock::time_point end)
      : checker_(checker),
        options_(options.refinement),
        wanted_(options.search.solutions),
        distinct_(checker.space().rest()) {
    options_.alpha = options.search.alpha;
    options_.cancelled = [cancelled = options.search.cancelled, end] {
      return Clock::now() > end || (cancelled && cancelled());
    };
  }

  std::vector<Candidate> refined(const BestFirstResult& found) {
    for (const Candidate& solution : found.solutions) add(solution, true);
    for (const Candidate& near : found.nearest) {
      if (static_cast<int>(solutions_.size()) >= wanted_) break;
      add(near, false);
    }
    std::stable_sort(solutions_.begin(), solutions_.end(), less_energy);
    return std::move(solutions_);
  }

  const std::optional<Candidate>& nearest() const { return nearest_; }

 private:
  void add(const Candidate& start, bool solved) {
    if (options_.cancelled()) {
      if (solved) keep(start);
      return;
    }
    RefinementResult result = refined_candidate(checker_, start, options_);
    if (result.reached)
      keep(std::move(result.candidate));
    else if (!nearest_ || result.candidate.measured.value > nearest_->measured.value)
      nearest_ = std::move(result.candidate);
  }

  /// Of two solutions that are not different the one of less energy stays.
  void keep(Candidate candidate) {
    for (Candidate& other : solutions_)
      if (!distinct_.differ(other.design, candidate.design)) {
        if (less_energy(candidate, other)) other = std::move(candidate);
        return;
      }
    solutions_.push_back(std::move(candidate));
  }

  const RequirementChecker& checker_;
  RefinementOptions options_;
  int wanted_;
  detail::Distinctness distinct_;
  std::vector<Candidate> solutions_;
  std::optional<Candidate> nearest_;
};

Candidate at_rest(const RequirementChecker& checker, const Eigen::Vector3d& direction) {
  Candidate rest;
  rest.design = checker.space().at_rest();
  rest.direction = direction;
  rest.measured = checker.measured(rest.design.shape, Direction(direction));
  return rest;
}

}  // namespace

Improvement improve(const RequirementChecker& checker, const ImprovementOptions& options,
                    const std::optional<std::string>& state) {
  const Clock::time_point end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                   std::chrono::duration<double>(options.search.seconds));
  const BestFirstOptions search = search_options(options);
  BestFirstResult found = state ? best_first_resumed(checker, search, *state) : best_first(checker, search);

  Improvement result;
  result.progress = found.progress;
  result.end = found.end;
  std::optional<Candidate> nearest;
  if (!found.nearest.empty()) nearest = found.nearest.front();
  if (options.preset == ImprovementPreset::refined) {
    Refiner refiner(checker, options, end);
    result.solutions = refiner.refined(found);
    if (refiner.nearest() && (!nearest || refiner.nearest()->measured.value > nearest->measured.value))
      nearest = refiner.nearest();
  } else {
    result.solutions = found.solutions;
  }
  for (const Candidate& solution : result.solutions)
    result.assessments.push_back(checker.checked(solution.design, Direction(solution.direction)));

  Eigen::Vector3d direction = options.search.directions.front();
  if (!result.solutions.empty()) {
    direction = result.solutions.front().direction;
  } else if (nearest) {
    direction = nearest->direction;
    found.nearest.insert(found.nearest.begin(), *nearest);
    result.diagnosis = diagnosed(checker, found);
    result.nearest = std::move(nearest);
  }
  result.before = at_rest(checker, direction);
  return result;
}

}  // namespace stackabilization
