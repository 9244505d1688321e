#include "improvement/refinement/magnitude_optimiser.h"

#include <algorithm>
#include <cmath>

namespace stackabilization::detail {

namespace {

/// First and least radius of the trust region, in magnitudes.
constexpr double first_radius = 0.5;
constexpr double min_radius = 0.001;

/// Stop when the predicted decrease is below this fraction of the merit.
constexpr double min_predicted_decrease = 0.0001;

/// Accept a step whose actual decrease is at least this share of the predicted decrease.
constexpr double min_share = 0.1;

/// Number of rejected steps answered with the slopes at hand before slopes are measured at a rejected point.
constexpr std::size_t max_corrections = 2;

/// Number of times that slopes are measured at rejected points before the trust region shrinks.
constexpr int max_cut_rounds = 1;

/// A step of at least this share of the radius enlarges the trust region.
constexpr double share_of_radius = 0.99;

/// Bundle method in a trust region.
class BundleDescent {
 public:
  BundleDescent(MagnitudeProblem& problem, const MagnitudeRun& run)
      : problem_(problem),
        run_(run),
        radius_(first_radius),
        base_(problem.at(run.start)),
        model_(run.goal, run.start, base_, problem.slopes(run.start)) {}

  Magnitudes end() {
    while (radius_ >= min_radius && !done()) {
      const MagnitudeModel::Step step = model_.step(limits(-radius_), limits(radius_));
      const bool promising = step.predicted_decrease > min_predicted_decrease * std::abs(model_.merit(base_));
      if (promising)
        try_step(step);
      else if (!failed_.empty())
        add_cuts();
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
    } else if (accepted(sample, step.predicted_decrease)) {
      if (length >= share_of_radius * radius_) radius_ = 2 * radius_;
      base_ = sample;
      failed_.clear();
      cut_rounds_ = 0;
      if (!done()) model_.move_to(step.to, base_, problem_.slopes(step.to));
    } else if (!(sample.violations.maxCoeff() > 0)) {
      radius_ = length / 2;
    } else {
      failed_.push_back(step.to);
      if (failed_.size() <= max_corrections)
        model_.correct(step.to, sample);
      else
        add_cuts();
    }
  }

  /// Adds cuts at the last rejected point. From the second time after an accepted step on, the radius becomes
  /// half the length of the rejected step.
  void add_cuts() {
    const Magnitudes at = failed_.back();
    model_.add(at, problem_.at(at), problem_.slopes(at));
    if (++cut_rounds_ > max_cut_rounds) radius_ = length(at) / 2;
    failed_.clear();
  }

  bool done() const {
    return problem_.stopped() || (run_.goal == MagnitudeGoal::feasible && problem_.best());
  }

  bool accepted(const MagnitudeSample& sample, double predicted_decrease) const {
    const bool allowed = run_.goal == MagnitudeGoal::feasible || sample.feasible;
    return allowed && model_.merit(base_) - model_.merit(sample) >= min_share * predicted_decrease;
  }

  double length(const Magnitudes& to) const {
    double largest = 0;
    for (std::size_t k = 0; k < to.size(); ++k)
      largest = std::max(largest, std::abs(to[k] - model_.centre()[k]));
    return largest;
  }

  /// Returns one side of the box that the trust region and the bounds of the problem leave.
  Magnitudes limits(double by) const {
    Magnitudes result = model_.centre();
    for (double& magnitude : result)
      magnitude = std::clamp(magnitude + by, problem_.lowest(), problem_.highest());
    return result;
  }

  MagnitudeProblem& problem_;
  const MagnitudeRun& run_;
  double radius_;
  std::vector<Magnitudes> failed_;  ///< points rejected since cuts were last added
  int cut_rounds_ = 0;              ///< times cuts were added since the last accepted step
  MagnitudeSample base_;
  MagnitudeModel model_;
};

}  // namespace

Magnitudes optimise_magnitudes(MagnitudeProblem& problem, const MagnitudeRun& run) {
  return BundleDescent(problem, run).end();
}

}  // namespace stackabilization::detail
