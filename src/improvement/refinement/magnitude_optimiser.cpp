#include "improvement/refinement/magnitude_optimiser.h"

#include <algorithm>
#include <cmath>

namespace stackabilization::detail {

namespace {

/// The trust region at first, and the least one.
constexpr double first_radius = 0.5;
constexpr double least_radius = 0.001;

/// A run ends when the model promises less than this fraction of the merit.
constexpr double least_promise = 0.0001;

/// A step that keeps this share of what was promised is taken.
constexpr double least_share = 0.1;

/// Failed steps that are answered with the slopes at hand before new ones are measured.
constexpr std::size_t most_corrections = 2;

/// So often slopes are measured at failures before the trust region shrinks.
constexpr int most_lessons = 1;

/// A step as long as this share of the radius would have gone farther.
constexpr double share_of_radius = 0.99;

class BundleDescent {
 public:
  BundleDescent(MagnitudeProblem& problem, const MagnitudeRun& run)
      : problem_(problem),
        run_(run),
        radius_(first_radius),
        base_(problem.at(run.start)),
        model_(run.goal, run.start, base_, problem.slopes(run.start)) {}

  Magnitudes end() {
    while (radius_ >= least_radius && !done()) {
      const MagnitudeModel::Step step = model_.step(limits(-radius_), limits(radius_));
      const bool promising = step.promised > least_promise * std::abs(model_.merit(base_));
      if (promising)
        try_step(step);
      else if (!failed_.empty())
        learn();
      else
        break;
    }
    return model_.centre();
  }

 private:
  void try_step(const MagnitudeModel::Step& step) {
    const MagnitudeSample sample = problem_.at(step.to);
    const double length = this->length(step.to);
    if (!sample.made) {
      radius_ = length / 4;
    } else if (accepted(sample, step.promised)) {
      if (length >= share_of_radius * radius_) radius_ = 2 * radius_;
      base_ = sample;
      failed_.clear();
      learnt_ = 0;
      if (!done()) model_.move_to(step.to, base_, problem_.slopes(step.to));
    } else if (!(sample.shortfalls.maxCoeff() > 0)) {
      radius_ = length / 2;
    } else {
      failed_.push_back(step.to);
      if (failed_.size() <= most_corrections)
        model_.correct(step.to, sample);
      else
        learn();
    }
  }

  /// What the last failure looks like from there; steps go half as far from now on.
  void learn() {
    const Magnitudes at = failed_.back();
    model_.add(at, problem_.at(at), problem_.slopes(at));
    if (++learnt_ > most_lessons) radius_ = length(at) / 2;
    failed_.clear();
  }

  bool done() const {
    return problem_.stopped() || (run_.goal == MagnitudeGoal::feasible && problem_.best());
  }

  bool accepted(const MagnitudeSample& sample, double promised) const {
    const bool allowed = run_.goal == MagnitudeGoal::feasible || sample.feasible;
    return allowed && model_.merit(base_) - model_.merit(sample) >= least_share * promised;
  }

  double length(const Magnitudes& to) const {
    double largest = 0;
    for (std::size_t k = 0; k < to.size(); ++k)
      largest = std::max(largest, std::abs(to[k] - model_.centre()[k]));
    return largest;
  }

  /// One side of what the trust region and the problem leave.
  Magnitudes limits(double by) const {
    Magnitudes result = model_.centre();
    for (double& magnitude : result)
      magnitude = std::clamp(magnitude + by, problem_.lowest(), problem_.highest());
    return result;
  }

  MagnitudeProblem& problem_;
  const MagnitudeRun& run_;
  double radius_;
  std::vector<Magnitudes> failed_;  ///< since something was learnt
  int learnt_ = 0;                  ///< failures looked at from where they are, since the last step taken
  MagnitudeSample base_;
  MagnitudeModel model_;
};

}  // namespace

Magnitudes optimised_magnitudes(MagnitudeProblem& problem, const MagnitudeRun& run) {
  return BundleDescent(problem, run).end();
}

}  // namespace stackabilization::detail
