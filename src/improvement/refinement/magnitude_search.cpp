#include "improvement/refinement/magnitude_search.h"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>

#include "improvement/refinement/magnitude_optimiser.h"
#include "stackabilization/improvement/tolerances.h"

namespace stackabilization::detail {

namespace {

/// Uniform multiples of the given magnitudes, tried first when these do not reach the target.
constexpr double multiples[] = {1.25, 1.5, 2, 3};

/// Largest number of runs of the optimiser. Each run starts from the best point so far, with its own pairs of
/// blocks. A run makes no progress if it lessens the change, or what S lacks to 1, by less than
/// min_relative_progress. When the change is minimised, runs alternate between short and long finite
/// differences until neither makes progress.
constexpr int max_runs = 8;
constexpr double min_relative_progress = 0.001;

/// If a list of more edits than this shrinks to half by removing unneeded edits, the rest is refined afresh.
constexpr std::size_t max_dropped_at_once = 6;

/// Share of the evaluations that the optimiser may use. The rest is for the steps after it.
constexpr double share_of_descent = 0.8;

/// Largest number of rounds that pull back one magnitude after the other.
constexpr int max_sweeps = 3;

/// Largest number of steps of a search along a segment. S is taken to jump where the bracket is narrow and S
/// stays farther from the aim than `steep` times the bracket.
constexpr std::uintmax_t max_steps = 40;
constexpr double steep = 1000;

/// Enlargements of the other magnitudes, minus 1, tried when edits are dropped; and the relative growth of
/// the change that this may cost.
constexpr double make_up[] = {
    0, 1. / (1 << 20), 1. / (1 << 16), 1. / (1 << 12), 1. / (1 << 8), 1. / (1 << 6)};
constexpr double spare_change = 0.005;
/// Further enlargements tried if edits have a price.
constexpr double more_make_up[] = {1. / 32, 1. / 16, 1. / 8, 1. / 4};

Magnitudes scaled(Magnitudes x, double factor) {
  for (double& magnitude : x) magnitude *= factor;
  return x;
}

/// Returns the number of edits with a magnitude other than 0.
std::size_t made(const Magnitudes& x) {
  return x.size() - static_cast<std::size_t>(std::count(x.begin(), x.end(), 0.0));
}

class MagnitudeSearch {
 public:
  MagnitudeSearch(MagnitudeProblem& problem, const Magnitudes& given, const RefinementOptions& options)
      : problem_(problem), given_(given), options_(options) {}

  void run() {
    if (!problem_.at(given_).feasible) reach();
    if (!problem_.best()) return;
    const std::size_t given = made(given_);
    do_without();
    pull_back();
    if (given > max_dropped_at_once && 2 * made(*problem_.best()) <= given) return;
    descend();
    pull_back_singly();
    leave_out();
    pull_back();
  }

 private:
  /// Phase 1: finds any feasible point.
  void reach() {
    std::vector<Magnitudes> larger;
    for (const double factor : multiples)
      if (factor <= options_.magnitude_bound) larger.push_back(scaled(given_, factor));
    problem_.prepare(larger);
    for (int run = 0; run < max_runs && !problem_.best() && !problem_.stopped(); ++run) {
      const Magnitudes from = problem_.nearest().value_or(given_);
      const double before = problem_.nearest_stackability();
      problem_.constrain_pairs(from);
      optimise_magnitudes(problem_, {from, MagnitudeGoal::feasible});
      if (problem_.nearest_stackability() - before < min_relative_progress * (1 - before)) break;
    }
  }

  /// Removes edits that the target does not need, one after the other, those whose removal leaves the least
  /// change first.
  void do_without() {
    const double given = problem_.best_change();
    std::vector<std::pair<double, std::size_t>> spare;
    for (const auto& [k, sample] : each_left_out(*problem_.best()))
      if (sample.feasible && sample.change <= given) spare.emplace_back(sample.change, k);
    std::sort(spare.begin(), spare.end());
    for (const auto& [change, k] : spare) {
      if (problem_.stopped()) return;
      Magnitudes without = *problem_.best();
      without[k] = 0;
      const MagnitudeSample& sample = problem_.at(without);
      if (sample.feasible && sample.change <= problem_.best_change()) problem_.prefer(without);
    }
  }

  /// Measures `x` without each of its edits; pairs of the edit's row and the sample.
  std::vector<std::pair<std::size_t, MagnitudeSample>> each_left_out(const Magnitudes& x) {
    std::vector<std::size_t> rows;
    std::vector<Magnitudes> fewer;
    for (std::size_t k = 0; k < x.size(); ++k) {
      if (x[k] == 0) continue;
      rows.push_back(k);
      fewer.push_back(x);
      fewer.back()[k] = 0;
    }
    problem_.prepare(fewer);
    std::vector<std::pair<std::size_t, MagnitudeSample>> result;
    for (std::size_t i = 0; i < rows.size(); ++i) result.emplace_back(rows[i], problem_.at(fewer[i]));
    return result;
  }

  /// Phase 2: minimises the change.
  void descend() {
    problem_.allow(static_cast<int>(share_of_descent * options_.evaluations));
    int idle = 0;
    for (int run = 0; run < max_runs && idle < 2 && !problem_.stopped(); ++run) {
      const Magnitudes from = *problem_.best();
      const double before = problem_.best_change();
      problem_.step_by(run % 2 == 0 ? min_magnitude_step : max_magnitude_step);
      problem_.constrain_pairs(from);
      optimise_magnitudes(problem_, {from, MagnitudeGoal::min_change});
      pull_back();
      idle = problem_.best_change() < before * (1 - min_relative_progress) ? 0 : idle + 1;
    }
    problem_.allow(options_.evaluations);
  }

  /// Finds the last feasible point on the segment from the best point to `to`. Does nothing if `to` is
  /// feasible or has no smaller change.
  void approach(const Magnitudes& to) {
    const Magnitudes from = *problem_.best();
    const MagnitudeSample there = problem_.at(to);
    if (there.feasible || (there.made && there.change >= problem_.best_change())) return;
    const auto point = [&](double share) {
      Magnitudes x = from;
      for (std::size_t k = 0; k < x.size(); ++k) x[k] += share * (to[k] - from[k]);
      return x;
    };
    double surplus = 1;
    const auto margin = [&](double share) {
      const MagnitudeSample& sample = problem_.at(point(share));
      if (!sample.made) return -1.0;
      const double above = sample.stackability - problem_.target();
      if (sample.feasible) surplus = std::min(surplus, std::abs(above));
      return sample.feasible ? above : std::min(above, -tolerance::target);
    };
    const auto close_enough = [&](double a, double b) {
      const double width = std::abs(b - a);
      const bool jump = width <= tolerance::magnitude && surplus > steep * width;
      return surplus <= tolerance::target / 2 || jump || problem_.stopped();
    };
    const double at_start = margin(0), at_end = margin(1);
    if (!(at_start > 0) || !(at_end < 0)) return;
    std::uintmax_t steps = max_steps;
    boost::math::tools::toms748_solve(margin, 0.0, 1.0, at_start, at_end, close_enough, steps);
  }

  /// Moves the best point towards the shape at rest as far as the target allows.
  void pull_back() { approach(Magnitudes(problem_.size(), 0)); }

  /// Pulls back one magnitude after the other while that helps. Needed where S jumps: slopes do not show
  /// jumps.
  void pull_back_singly() {
    for (int sweep = 0; sweep < max_sweeps; ++sweep) {
      const double before = problem_.best_change();
      for (std::size_t k = 0; k < problem_.size() && !problem_.stopped(); ++k) {
        if (problem_.at(*problem_.best()).stackability <= problem_.target() + tolerance::target / 2) return;
        Magnitudes without = *problem_.best();
        without[k] = 0;
        approach(without);
      }
      if (!(problem_.best_change() < before * (1 - min_relative_progress))) return;
    }
  }

  /// Drops edits that hardly matter, as many as the others can make up for, those that S needs least first.
  /// Runs even when the time is up: a solution should not have many edits that do next to nothing.
  void leave_out() {
    const Magnitudes best = *problem_.best();
    const double change = problem_.best_change();
    const auto allowed = [&](std::size_t dropped) {
      return change * (1 + spare_change + options_.edit_price * static_cast<double>(dropped));
    };
    std::vector<double> enlargements(std::begin(make_up), std::end(make_up));
    if (options_.edit_price > 0)
      enlargements.insert(enlargements.end(), std::begin(more_make_up), std::end(more_make_up));
    const double gained = problem_.target() - problem_.at(Magnitudes(best.size(), 0)).stackability;
    std::vector<std::pair<double, std::size_t>> little;
    for (const auto& [k, sample] : each_left_out(best))
      if (sample.passes && sample.change <= allowed(1) &&
          problem_.target() - sample.stackability <= options_.drop_threshold * gained)
        little.emplace_back(-sample.stackability, k);
    std::sort(little.begin(), little.end());
    const auto goes_without = [&](std::size_t count) {
      Magnitudes fewer = best;
      for (std::size_t i = 0; i < count; ++i) fewer[little[i].second] = 0;
      for (const double more : enlargements) {
        const Magnitudes x = scaled(fewer, 1 + more);
        if (!problem_.at(x).feasible) continue;
        if (problem_.at(x).change > allowed(count)) return false;
        problem_.prefer(x);
        return true;
      }
      return false;
    };
    std::size_t possible = 0, too_many = little.size() + 1;
    for (std::size_t next = little.size(); too_many - possible > 1; next = (possible + too_many) / 2)
      (goes_without(next) ? possible : too_many) = next;
  }

  MagnitudeProblem& problem_;
  const Magnitudes& given_;
  const RefinementOptions& options_;
};

}  // namespace

void search_magnitudes(MagnitudeProblem& problem, const Magnitudes& given, const RefinementOptions& options) {
  MagnitudeSearch(problem, given, options).run();
}

}  // namespace stackabilization::detail
