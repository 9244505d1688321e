#include "stackabilization/improvement/front.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "stackabilization/core/errors.h"
#include "stackabilization/stacking/tolerances.h"

namespace stackabilization {

namespace {

/// Computes a front, target by target.
class FrontRun {
 public:
  FrontRun(const RequirementChecker& checker, const FrontOptions& options)
      : checker_(checker), options_(options), runs_(options.bisections + options.points - 1) {
    if (options.points < 2) throw UsageError("a front has two points at least");
    if (checker.requirements().length_limit)
      throw UsageError("a front goes by S: a length limit has no place in it");
    if (options.improvement.preset != ImprovementPreset::refined)
      throw UsageError("a front needs refined designs");
    options_.improvement.search.solutions = 1;
    options_.improvement.search.save = {};
  }

  Front run() {
    const FrontPoint rest = at_rest();
    const double target = checker_.requirements().target, lowest = rest.candidate.measured.value;
    std::optional<FrontPoint> top;
    if (target > lowest) top = largest(lowest, target);
    result_.points = {rest};
    if (top) fill(lowest, std::move(*top));
    return std::move(result_);
  }

 private:
  /// Returns the checker for another target; what is known of the shape at rest is shared.
  RequirementChecker checker_of(double target) const {
    Requirements requirements = checker_.requirements();
    requirements.target = target;
    // The space outlives this run, and with it the shape at rest.
    return {checker_.space(), std::move(requirements),
            std::shared_ptr<const RestShape>(std::shared_ptr<const RestShape>(), &checker_.rest_shape())};
  }

  FrontPoint at_rest() const {
    FrontPoint rest;
    rest.candidate.design = checker_.space().at_rest();
    rest.candidate.direction = options_.improvement.search.directions.front();
    const Direction direction(rest.candidate.direction);
    rest.candidate.measured = checker_.rest_shape().measure(direction);
    rest.target = rest.candidate.measured.value;
    rest.assessment = checker_of(rest.target).check(rest.candidate.design, direction);
    return rest;
  }

  bool stopped() const { return result_.end == SearchEnd::cancelled || result_.end == SearchEnd::time_limit; }

  /// Improves for a target, from `starts` too.
  Improvement improved(double target, std::vector<Candidate> starts) {
    if (options_.progress) options_.progress(run_++, runs_);
    const RequirementChecker checker = checker_of(target);
    ImprovementOptions improvement = options_.improvement;
    improvement.starts = std::move(starts);
    Improvement found = improve(checker, improvement);
    result_.evaluated += found.progress.evaluated;
    if (found.end == SearchEnd::cancelled || found.end == SearchEnd::time_limit) result_.end = found.end;
    return found;
  }

  FrontPoint point(double target, Improvement found) const {
    FrontPoint result{target, std::move(found.solutions.front()), std::move(found.assessments.front())};
    result.change =
        size_of(options_.improvement.refinement.objective, result.candidate, checker_.space().rest().shape);
    if (options_.found) options_.found(result.candidate);
    return result;
  }

  /// Returns the design for `target` or, where that is missed, for the largest target that bisection reaches.
  std::optional<FrontPoint> largest(double lowest, double target) {
    Improvement found = improved(target, {});
    result_.reached = !found.solutions.empty();
    if (result_.reached) return point(target, std::move(found));
    result_.diagnosis = std::move(found.diagnosis);
    result_.nearest = found.nearest;
    std::vector<Candidate> near;
    if (found.nearest) near.push_back(std::move(*found.nearest));
    std::optional<FrontPoint> best;
    double reached = lowest, missed = target;
    for (int k = 0; k < options_.bisections && !stopped(); ++k) {
      // What came nearest is a design, which may break a limit.
      const double nearest = k == 0 && !near.empty() ? near.front().measured.value : reached;
      const double next = nearest > reached && nearest < missed ? nearest : (reached + missed) / 2;
      std::vector<Candidate> starts = near;
      if (best) starts.insert(starts.begin(), best->candidate);
      Improvement tried = improved(next, std::move(starts));
      if (tried.solutions.empty()) {
        missed = next;
        if (tried.diagnosis) result_.diagnosis = std::move(tried.diagnosis);
      } else {
        best = point(next, std::move(tried));
        reached = next;
      }
    }
    if (result_.diagnosis) {
      result_.diagnosis->target = target;
      if (best && best->candidate.measured.value > result_.diagnosis->reached) {
        result_.diagnosis->reached = best->candidate.measured.value;
        result_.diagnosis->direction = best->candidate.direction;
      }
    }
    return best;
  }

  /// Appends the designs up to `top`. Each target begins with the design of the next larger one, so that its
  /// change is no larger.
  void fill(double lowest, FrontPoint top) {
    std::vector<FrontPoint> descending = {std::move(top)};
    const double highest = descending.front().target;
    for (int k = options_.points - 2; k > 0 && !stopped(); --k) {
      const double target = lowest + (highest - lowest) * k / (options_.points - 1);
      if (target - lowest <= tolerance::stackability) break;
      descending.push_back(point(target, improved(target, {descending.back().candidate})));
    }
    for (auto next = descending.rbegin(); next != descending.rend(); ++next) {
      // Where S jumps, a design may reach the next target too.
      const FrontPoint& before = result_.points.back();
      if (before.candidate.measured.value >= next->target && before.change <= next->change) {
        const double target = next->target;
        *next = before;
        next->target = target;
      }
      result_.points.push_back(std::move(*next));
    }
  }

  const RequirementChecker& checker_;
  FrontOptions options_;
  int run_ = 0, runs_;
  Front result_;
};

}  // namespace

Front improvement_front(const RequirementChecker& checker, const FrontOptions& options) {
  return FrontRun(checker, options).run();
}

Front improvement_front(const ImprovementTask& task, FrontOptions options) {
  options.improvement.search.directions = task.directions();
  return improvement_front(task.checker(), options);
}

}  // namespace stackabilization
