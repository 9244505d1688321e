#include "stackabilization/improvement/refinement.h"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <utility>

#include "stackabilization/improvement/edit_magnitudes.h"
#include "stackabilization/improvement/magnitude_optimiser.h"
#include "stackabilization/improvement/magnitude_problem.h"
#include "stackabilization/shape/errors.h"
#include "stackabilization/shape/tolerances.h"

namespace stackabilization {

namespace {

using namespace detail;

/// Uniform multiples of the magnitudes that are tried before anything else when the target is not reached.
constexpr double multiples[] = {1.25, 1.5, 2, 3};

/// Runs of the optimiser, each from the best point so far with its own pairs of blocks. One that lessens the
/// change or raises S by less than this fraction is the last.
constexpr int most_runs = 8;
constexpr double least_progress = 0.001;

/// Further edits join in rounds, few at a time: every variable costs a sample per slope. They are chosen by
/// how much the change would fall, of itself, per unit of magnitude, according to the slopes within a radius;
/// less than this is not worth it, and a round that lessens the change by less than this is the last.
constexpr int most_rounds = 4;
constexpr double pricing_radius = 0.1;
constexpr double least_pull = 0.01;
constexpr double least_gain = 0.01;

/// Of longer lists that shrink to half by leaving out what is not needed the rest is refined afresh.
constexpr std::size_t most_at_once = 6;

/// The optimiser may use the evaluations up to this share of all: the rest is for what comes after.
constexpr double share_of_descent = 0.8;

/// Refinements of what another one found with fewer edits, and what one of them needs at least.
constexpr int most_restarts = 3;
constexpr int least_evaluations = 10;

/// Rounds of pulling back one magnitude after the other.
constexpr int most_sweeps = 3;

/// Steps of a search along a segment, and how far S must stay from what is aimed at, in multiples of the
/// bracket, where the bracket is narrow, for a jump.
constexpr std::uintmax_t most_steps = 40;
constexpr double steep = 1000;

/// Multiples less 1 of the other magnitudes that are tried when an edit is left out.
constexpr double make_up[] = {
    0, 1. / (1 << 20), 1. / (1 << 16), 1. / (1 << 12), 1. / (1 << 8), 1. / (1 << 6)};

Magnitudes scaled(Magnitudes x, double factor) {
  for (double& magnitude : x) magnitude *= factor;
  return x;
}

/// The last word on one candidate: everything checked.
struct Verdict {
  Candidate candidate;
  bool reached = false;
  double change = 0;
};

/// One refinement.
class Refiner {
 public:
  /// `joining`: edits that may be added to those of the start.
  Refiner(const RequirementChecker& checker, const Candidate& start, const RefinementOptions& options,
          const std::vector<MagnitudeEdit>& joining = {})
      : checker_(checker),
        start_(start),
        options_(options),
        direction_(start.direction),
        edits_(variables(checker, start, options, joining)),
        meter_(checker.space().rest(), checker.requirements().measure.boxes, options.alpha),
        problem_(checker, plain(edits_), direction_,
                 {options.evaluations, options.reach, options.least, options.cancelled}) {}

  /// Those of `possible` that promise to lessen the change most, at most `most`; as the slopes at the start
  /// say.
  std::vector<MagnitudeEdit> promising(std::size_t most) {
    const Magnitudes x = found();
    if (!problem_.at(x).made) return {};
    problem_.constrain_pairs(x);
    const MagnitudeSlopes slopes = problem_.slopes(x);
    const MagnitudeModel model(MagnitudeGoal::unchanged, x, problem_.at(x), slopes);
    Magnitudes low = x, high = x;
    for (double& magnitude : low) magnitude -= pricing_radius;
    for (double& magnitude : high) magnitude += pricing_radius;
    const Eigen::VectorXd pulls = model.step(low, high).pull;
    const double least = least_pull * model.merit(problem_.at(x));
    std::vector<std::pair<double, std::size_t>> ranked;
    for (std::size_t k = 0; k < edits_.size(); ++k) {
      const double pull = pulls(static_cast<Eigen::Index>(k));
      if (!edits_[k].source && slopes.made[k] && pull > least) ranked.emplace_back(-pull, k);
    }
    std::sort(ranked.begin(), ranked.end());
    if (ranked.size() > most) ranked.resize(most);
    std::vector<MagnitudeEdit> result;
    for (const auto& [pull, k] : ranked) result.push_back(edits_[k]);
    return result;
  }

  int evaluations() const { return problem_.evaluations(); }

  RefinementResult result() {
    const Verdict given = judged(start_.design, start_.reasons);
    Verdict best = given;
    if (!edits_.empty() && problem_.at(found()).made) {
      search();
      for (const Magnitudes& x : finalists()) {
        Verdict verdict = judged(x);
        if (better(verdict, best)) best = std::move(verdict);
        if (best.reached) break;
      }
    }
    return {std::move(best.candidate), best.reached, problem_.evaluations()};
  }

 private:
  /// The edits given, merged where their order does not matter so much that they are refused, and what joins.
  static std::vector<MagnitudeEdit> variables(const RequirementChecker& checker, const Candidate& start,
                                              const RefinementOptions& options,
                                              const std::vector<MagnitudeEdit>& joining) {
    const DeformationConstraints constraints =
        deformation_constraints(checker.requirements(), checker.space().rest(), Direction(start.direction));
    std::vector<MagnitudeEdit> edits =
        merged_edits(start.design.edits, [&](const std::vector<MagnitudeEdit>& fewer) {
          const bool late = options.cancelled && options.cancelled();  // long lists take long to replay
          return !late && !checker.space().replayed(plain(fewer), constraints).refusal;
        });
    edits.insert(edits.end(), joining.begin(), joining.end());
    return edits;
  }
  static std::vector<Edit> plain(const std::vector<MagnitudeEdit>& edits) {
    std::vector<Edit> result;
    for (const MagnitudeEdit& one : edits) result.push_back(one.edit);
    return result;
  }
  /// The magnitudes of what was given.
  Magnitudes found() const {
    Magnitudes x;
    for (const MagnitudeEdit& one : edits_) x.push_back(one.source ? 1 : 0);
    return x;
  }
  Magnitudes at_rest() const { return Magnitudes(edits_.size(), 0); }
  static std::size_t made(const Magnitudes& x) {
    return x.size() - static_cast<std::size_t>(std::count(x.begin(), x.end(), 0.0));
  }
  static double stackability(const Verdict& verdict) { return verdict.candidate.measured.value; }
  /// Fewer edits are better where the change is the same.
  static bool better(const Verdict& a, const Verdict& b) {
    if (a.reached != b.reached) return a.reached;
    if (!a.reached) return stackability(a) > stackability(b);
    return std::pair(a.change, a.candidate.design.edits.size()) <
           std::pair(b.change, b.candidate.design.edits.size());
  }

  void search() {
    if (!problem_.at(found()).feasible) reach();
    if (!problem_.best()) return;
    const std::size_t given = made(found());
    do_without();
    pull_back();
    if (given > most_at_once && 2 * made(*problem_.best()) <= given) return;
    descend();
    pull_back_singly();
    leave_out();
    pull_back();
  }

  /// Phase 1: any feasible point.
  void reach() {
    std::vector<Magnitudes> larger;
    for (const double factor : multiples)
      if (factor <= options_.reach) larger.push_back(scaled(found(), factor));
    problem_.prepare(larger);
    for (int run = 0; run < most_runs && !problem_.best() && !problem_.stopped(); ++run) {
      const Magnitudes from = problem_.nearest().value_or(found());
      const double before = problem_.nearest_stackability();
      problem_.constrain_pairs(from);
      optimised_magnitudes(problem_, {from, MagnitudeGoal::feasible});
      if (problem_.nearest_stackability() - before < least_progress * (1 - before)) break;
    }
  }

  /// Takes away edits that the target does not need, one after the other, those whose loss lessens the change
  /// most first.
  void do_without() {
    const double given = problem_.best_change();
    std::vector<std::pair<double, std::size_t>> spare;
    for (const auto& [k, sample] : each_left_out(*problem_.best()))
      if (sample.feasible && sample.change <= given) spare.emplace_back(sample.change, k);
    std::sort(spare.begin(), spare.end());
    for (const auto& [distortion, k] : spare) {
      if (problem_.stopped()) return;
      Magnitudes without = *problem_.best();
      without[k] = 0;
      const MagnitudeSample& sample = problem_.at(without);
      if (sample.feasible && sample.change <= problem_.best_change()) problem_.prefer(without);
    }
  }

  /// What becomes of `x` without one of its edits, by the row of that edit.
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

  /// Phase 2.
  void descend() {
    problem_.allow(static_cast<int>(share_of_descent * options_.evaluations));
    for (int run = 0; run < most_runs && !problem_.stopped(); ++run) {
      const Magnitudes from = *problem_.best();
      const double before = problem_.best_change();
      problem_.constrain_pairs(from);
      optimised_magnitudes(problem_, {from, MagnitudeGoal::unchanged});
      pull_back();
      if (!(problem_.best_change() < before * (1 - least_progress))) break;
    }
    problem_.allow(options_.evaluations);
  }

  /// Looks for the last feasible point on the way from the best one to `to`, if that promises less change.
  void approach(const Magnitudes& to) {
    const Magnitudes from = *problem_.best();
    const MagnitudeSample there = problem_.at(to);
    if (there.feasible || (there.made && there.change >= problem_.best_change())) return;
    const auto point = [&](double share) {
      Magnitudes x = from;
      for (std::size_t k = 0; k < x.size(); ++k) x[k] += share * (to[k] - from[k]);
      return x;
    };
    double excess = 1;
    const auto margin = [&](double share) {
      const MagnitudeSample& sample = problem_.at(point(share));
      if (!sample.made) return -1.0;
      const double above = sample.stackability - problem_.aim();
      if (sample.feasible) excess = std::min(excess, std::abs(above));
      return sample.feasible ? above : std::min(above, -tolerance::target);
    };
    const auto close_enough = [&](double a, double b) {
      const double width = std::abs(b - a);
      const bool jump = width <= tolerance::magnitude && excess > steep * width;
      return excess <= tolerance::target / 2 || jump || problem_.stopped();
    };
    const double at_start = margin(0), at_end = margin(1);
    if (!(at_start > 0) || !(at_end < 0)) return;
    std::uintmax_t steps = most_steps;
    boost::math::tools::toms748_solve(margin, 0.0, 1.0, at_start, at_end, close_enough, steps);
  }

  /// Towards the shape at rest as far as the target allows.
  void pull_back() { approach(at_rest()); }

  /// The same with one magnitude after the other, for as long as that helps: what is left to do where S
  /// jumps, which slopes do not tell.
  void pull_back_singly() {
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
      const double before = problem_.best_change();
      for (std::size_t k = 0; k < edits_.size() && !problem_.stopped(); ++k) {
        if (problem_.at(*problem_.best()).stackability <= problem_.aim() + tolerance::target / 2) return;
        Magnitudes without = *problem_.best();
        without[k] = 0;
        approach(without);
      }
      if (!(problem_.best_change() < before * (1 - least_progress))) return;
    }
  }

  /// Leaves out edits that hardly matter, those that S needs least first, and makes up for each with the
  /// others.
  void leave_out() {
    const double gained = problem_.aim() - problem_.at(at_rest()).stackability;
    std::vector<std::pair<double, std::size_t>> little;
    for (const auto& [k, sample] : each_left_out(*problem_.best()))
      if (sample.passes && sample.change <= problem_.best_change() * (1 + least_progress) &&
          problem_.aim() - sample.stackability <= options_.negligible * gained)
        little.emplace_back(-sample.stackability, k);
    std::sort(little.begin(), little.end());
    for (const auto& [stackability, k] : little) {
      if (problem_.stopped()) return;
      Magnitudes without = *problem_.best();
      without[k] = 0;
      for (const double more : make_up) {
        const Magnitudes x = scaled(without, 1 + more);
        const MagnitudeSample& sample = problem_.at(x);
        if (!sample.feasible) continue;
        if (sample.change <= problem_.best_change() * (1 + least_progress)) problem_.prefer(x);
        break;
      }
    }
  }

  /// What is worth a full check: the best first.
  std::vector<Magnitudes> finalists() const {
    std::vector<Magnitudes> result;
    if (problem_.best()) result.push_back(*problem_.best());
    if (!problem_.best() && problem_.nearest()) result.push_back(*problem_.nearest());
    return result;
  }

  Verdict judged(const Magnitudes& x) const {
    std::vector<std::string> reasons;
    for (std::size_t k = 0; k < edits_.size(); ++k)
      if (x[k] != 0)
        reasons.push_back(edits_[k].source && *edits_[k].source < start_.reasons.size()
                              ? start_.reasons[*edits_[k].source]
                              : "makes up for the others");
    return judged(problem_.design(x).design, std::move(reasons));
  }

  Verdict judged(Design design, std::vector<std::string> reasons) const {
    Verdict verdict;
    const Assessment assessment = checker_.checked(design, direction_);
    Candidate& candidate = verdict.candidate;
    candidate.measured = assessment.measured;
    const double gain = start_.energy.gain + assessment.measured.value - start_.measured.value;
    candidate.energy = meter_.energy(design, gain);
    candidate.design = std::move(design);
    candidate.direction = start_.direction;
    candidate.reasons = std::move(reasons);
    verdict.reached = assessment.passed();
    verdict.change = size_of(options_.least, candidate, checker_.space().rest().shape);
    return verdict;
  }

  const RequirementChecker& checker_;
  const Candidate& start_;
  const RefinementOptions& options_;
  Direction direction_;
  std::vector<MagnitudeEdit> edits_;
  EnergyMeter meter_;
  MagnitudeProblem problem_;
};

/// Edits that are worth adding, and what it cost to find them.
struct Offer {
  std::vector<MagnitudeEdit> edits;
  int evaluations = 0;
};

Offer offered(const RequirementChecker& checker, const Candidate& candidate,
              const RefinementOptions& options) {
  std::vector<MagnitudeEdit> given;
  for (std::size_t k = 0; k < candidate.design.edits.size(); ++k)
    given.push_back({candidate.design.edits[k], k});
  Refiner all(checker, candidate, options,
              possible_edits(given, checker.space(), Direction(candidate.direction)));
  Offer offer;
  offer.edits = all.promising(static_cast<std::size_t>(options.joining));
  offer.evaluations = all.evaluations();
  return offer;
}

}  // namespace

RefinementResult refined_candidate(const RequirementChecker& checker, const Candidate& start,
                                   const RefinementOptions& options) {
  if (options.evaluations < least_evaluations)
    throw UsageError("a refinement needs at least " + std::to_string(least_evaluations) + " evaluations");
  if (!(options.reach > 0) || !std::isfinite(options.reach))
    throw UsageError("the reach of a refinement must be a positive number");
  if (options.joining < 0) throw UsageError("the number of edits that join must not be negative");
  if (!(options.negligible >= 0)) throw UsageError("the negligible magnitude must not be negative");
  RefinementResult result = Refiner(checker, start, options).result();
  const auto options_left = [&] {
    RefinementOptions left = options;
    left.evaluations -= result.evaluations;
    return left;
  };
  const auto goes_on = [&] {
    return result.reached && options_left().evaluations >= least_evaluations &&
           !(options.cancelled && options.cancelled());
  };
  const auto take = [&](RefinementResult next) {
    next.evaluations += result.evaluations;
    result = std::move(next);
  };
  std::size_t edits = start.design.edits.size();
  for (int restart = 0; restart < most_restarts && goes_on(); ++restart) {
    if (result.candidate.design.edits.size() >= edits) break;
    edits = result.candidate.design.edits.size();
    take(Refiner(checker, result.candidate, options_left()).result());
  }
  const Shape& rest = checker.space().rest().shape;
  for (int round = 0; options.joining > 0 && round < most_rounds && goes_on(); ++round) {
    const double before = size_of(options.least, result.candidate, rest);
    const Offer offer = offered(checker, result.candidate, options_left());
    result.evaluations += offer.evaluations;
    if (offer.edits.empty() || !goes_on()) break;
    take(Refiner(checker, result.candidate, options_left(), offer.edits).result());
    if (!(size_of(options.least, result.candidate, rest) < before * (1 - least_gain))) break;
  }
  return result;
}

}  // namespace stackabilization
