#include "stackabilization/improvement/improve.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "stackabilization/improvement/distinct.h"
#include "stackabilization/improvement/pursuit.h"

namespace stackabilization {

namespace {

using Clock = std::chrono::steady_clock;

/// Shares of the time by which the pursuits, the search in the paper's steps, and the search end where their
/// results are refined afterwards.
constexpr double pursuit_share = 0.4;
constexpr double paper_share = 0.45;
constexpr double search_share = 0.5;
/// By then the magnitudes of the edits that they found are known, and edits begin to join.
constexpr double first_share = 0.7;
/// Each search gets this share at least.
constexpr double least_search = 0.05;
/// Where nothing was found, what is left beyond this share is for the diagnosis.
constexpr double diagnosis_begin = 0.85;

/// Designs measured at most for the magnitudes of one list of edits.
constexpr int first_evaluations = 300;

/// Which solution becomes the best is not known before its refinement: so many at least are looked for, and
/// so many more than are wanted are tried with edits that join.
constexpr int least_solutions = 3;
constexpr std::size_t more_extended = 4;

/// The end of time where the clock does not count so far.
Clock::time_point after(Clock::time_point start, double seconds) {
  const std::chrono::duration<double> wanted(seconds);
  if (wanted >= Clock::time_point::max() - start) return Clock::time_point::max();
  return start + std::chrono::duration_cast<Clock::duration>(wanted);
}

bool more_stackable(const Candidate& a, const Candidate& b) {
  return a.measured.value > b.measured.value;
}

/// When the parts of a refinement end.
struct Deadlines {
  Clock::time_point give_up;  ///< all of it, while there is no solution
  Clock::time_point first;    ///< magnitudes of the edits found
  Clock::time_point end;      ///< of these and of edits that join
};

/// Refines what a search found: magnitudes of all of it first, then with further edits what came out best,
/// until there are as many different solutions as wanted.
class Refinements {
 public:
  Refinements(const RequirementChecker& checker, const ImprovementOptions& options,
              const Deadlines& deadlines)
      : checker_(checker),
        options_(options.refinement),
        wanted_(static_cast<std::size_t>(options.search.solutions)),
        deadlines_(deadlines),
        less_changed_([measure = options.refinement.least, &rest = checker.space().rest().shape](
                          const Candidate& a, const Candidate& b) {
          return size_of(measure, a, rest) < size_of(measure, b, rest);
        }),
        distinct_(checker.space().rest()) {
    options_.alpha = options.search.alpha;
    options_.cancelled = [this, cancelled = options.search.cancelled] {
      return Clock::now() > deadline_ || (cancelled && cancelled());
    };
  }
  Refinements(const Refinements&) = delete;
  Refinements& operator=(const Refinements&) = delete;

  /// `starts`: what else was found. Begins with what reaches the target with the least change: time may end.
  std::vector<Candidate> refined(std::vector<Candidate> starts, const BestFirstResult& found) {
    starts.insert(starts.end(), found.solutions.begin(), found.solutions.end());
    const double target = checker_.requirements().target;
    std::stable_sort(starts.begin(), starts.end(), [this, target](const Candidate& a, const Candidate& b) {
      const bool reached = a.measured.value >= target;
      if (reached != (b.measured.value >= target)) return reached;
      return reached ? less_changed_(a, b) : more_stackable(a, b);
    });
    deadline_ = deadlines_.give_up;
    for (const Candidate& start : starts) add(start);
    for (const Candidate& near : found.nearest) {
      if (solutions_.size() >= std::max<std::size_t>(wanted_, least_solutions) || options_.cancelled()) break;
      add(near);
    }
    extend();
    return std::move(solutions_);
  }

  const std::optional<Candidate>& nearest() const { return nearest_; }

 private:
  /// Out of time, it still looks whether the candidate is a solution as it is.
  void add(const Candidate& start) {
    if (start.design.edits.empty() && !checker_.reaches(start.measured)) return;
    RefinementOptions alone = options_;
    alone.joining = 0;
    alone.evaluations = std::min(options_.evaluations, first_evaluations);
    RefinementResult result = refined_candidate(checker_, start, alone);
    if (result.reached) {
      deadline_ = deadlines_.first;
      keep(std::move(result.candidate));
    } else if (!nearest_ || result.candidate.measured.value > nearest_->measured.value) {
      nearest_ = std::move(result.candidate);
    }
  }

  /// Lets further edits join, to the least changed solutions first.
  void extend() {
    deadline_ = deadlines_.end;
    std::stable_sort(solutions_.begin(), solutions_.end(), less_changed_);
    std::vector<Candidate> found;
    found.swap(solutions_);
    for (std::size_t k = 0; k < found.size(); ++k) {
      if (k < wanted_ + more_extended && !options_.cancelled())
        found[k] = refined_candidate(checker_, found[k], options_).candidate;
      keep(std::move(found[k]));
    }
    std::stable_sort(solutions_.begin(), solutions_.end(), less_changed_);
    if (solutions_.size() > wanted_) solutions_.resize(wanted_);
  }

  /// Of two solutions that are not different the less changed one stays.
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
  Deadlines deadlines_;
  Clock::time_point deadline_;  ///< of what it is at
  std::function<bool(const Candidate&, const Candidate&)> less_changed_;
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

BestFirstOptions in_the_papers_steps(BestFirstOptions search) {
  search.edits.family = EditFamily::paper;
  return search;
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// One pursuit per starting direction.
std::vector<Candidate> pursuits(const RequirementChecker& checker, const BestFirstOptions& search,
                                Clock::time_point end) {
  PursuitOptions options;
  options.alpha = search.alpha;
  options.edits = search.edits;
  options.cancelled = [cancelled = search.cancelled, end] {
    return Clock::now() > end || (cancelled && cancelled());
  };
  std::vector<Candidate> found;
  double first = 0;
  for (const Eigen::Vector3d& direction : search.directions) {
    Candidate start = at_rest(checker, direction);
    if (found.empty()) first = start.measured.value;
    start.energy.gain = start.measured.value - first;
    start.energy.value = -(1 - search.alpha) * start.energy.gain;
    found.push_back(pursued(checker, start, options));
  }
  return found;
}

}  // namespace

Improvement improve(const RequirementChecker& checker, const ImprovementOptions& options,
                    const std::optional<std::string>& state) {
  const Clock::time_point start = Clock::now();
  const double seconds = options.search.seconds;
  const bool refine = options.preset == ImprovementPreset::refined;
  BestFirstOptions search = options.search;
  std::vector<Candidate> starts;
  if (refine) {
    search.solutions = std::max(search.solutions, least_solutions);
    const auto until = [&](double share) {
      return std::max(share * seconds - seconds_since(start), least_search * seconds);
    };
    starts = pursuits(checker, search, after(start, pursuit_share * seconds));
    BestFirstOptions paper = in_the_papers_steps(search);
    paper.seconds = until(paper_share);
    paper.save = {};
    for (Candidate& solution : best_first(checker, paper).solutions) starts.push_back(std::move(solution));
    search.seconds = until(search_share);
  } else {
    search = in_the_papers_steps(search);
  }
  BestFirstResult found = state ? best_first_resumed(checker, search, *state) : best_first(checker, search);

  Improvement result;
  result.progress = found.progress;
  result.end = found.end;
  if (refine) {
    Refinements refinements(checker, options,
                            {after(start, diagnosis_begin * seconds), after(start, first_share * seconds),
                             after(start, seconds)});
    result.solutions = refinements.refined(std::move(starts), found);
    if (refinements.nearest()) found.nearest.insert(found.nearest.begin(), *refinements.nearest());
    std::stable_sort(found.nearest.begin(), found.nearest.end(), more_stackable);
    if (result.solutions.size() >= static_cast<std::size_t>(options.search.solutions) ||
        (!result.solutions.empty() && found.solutions.empty() && result.end == SearchEnd::exhausted))
      result.end = SearchEnd::solved;
  } else {
    result.solutions = found.solutions;
  }
  for (const Candidate& solution : result.solutions)
    result.assessments.push_back(checker.checked(solution.design, Direction(solution.direction)));

  Eigen::Vector3d direction = options.search.directions.front();
  if (!result.solutions.empty()) {
    direction = result.solutions.front().direction;
  } else if (!found.nearest.empty()) {
    direction = found.nearest.front().direction;
    result.diagnosis = diagnosed(checker, found, [&options, end = after(start, seconds)] {
      return Clock::now() > end || (options.search.cancelled && options.search.cancelled());
    });
    result.nearest = found.nearest.front();
  }
  result.before = at_rest(checker, direction);
  return result;
}

}  // namespace stackabilization
