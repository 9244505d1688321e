#include "stackabilization/improvement/refinement.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>

#include "stackabilization/improvement/magnitude_optimiser.h"
#include "stackabilization/improvement/magnitude_problem.h"
#include "stackabilization/shape/errors.h"
#include "stackabilization/shape/tolerances.h"

namespace stackabilization {

namespace {

using namespace detail;

/// Uniform multiples of the magnitudes that are tried before anything else when the target is not reached.
constexpr double multiples[] = {1.25, 1.5, 2, 3};

/// Runs of the optimiser, each from the best point so far with its own pairs of blocks. One that lessens D or
/// raises S by less than this fraction is the last, unless it came to where edits are refused or S jumps:
/// then the next may go only so much as far, down to the least radius.
constexpr int most_runs = 12;
constexpr double least_progress = 1e-3;
constexpr double less_far = 0.2;
constexpr double least_radius = 1e-3;

/// Steps of a search along a segment.
constexpr std::uintmax_t most_steps = 40;

/// +1 or -1 where the vectors lie on one line through 0, else 0.
int same_line(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  if (a.cross(b).norm() > tolerance::relative * a.norm() * b.norm()) return 0;
  return a.dot(b) < 0 ? -1 : 1;
}

/// Both operations as one, where they do the same thing.
struct Merge {
  std::optional<Operation> operator()(const Move& a, const Move& b) const {
    if (same_line(a.by, b.by) == 0) return std::nullopt;
    const Eigen::Vector3d sum = a.by + b.by;
    if (sum.norm() <= tolerance::relative * a.by.norm()) return Move{};
    return Move{sum};
  }
  std::optional<Operation> operator()(const Rotate& a, const Rotate& b) const {
    const int side = same_line(a.axis, b.axis);
    if (side == 0) return std::nullopt;
    const double sum = a.radians + side * b.radians;
    return Rotate{a.axis, std::abs(sum) <= tolerance::relative * std::abs(a.radians) ? 0 : sum};
  }
  std::optional<Operation> operator()(const Scale& a, const Scale& b) const {
    if (a.along.has_value() != b.along.has_value()) return std::nullopt;
    if (a.along && same_line(*a.along, *b.along) == 0) return std::nullopt;
    const double product = a.factor * b.factor;
    return Scale{std::abs(product - 1) <= tolerance::relative ? 1 : product, a.along};
  }
  template <typename A, typename B>
  std::optional<Operation> operator()(const A&, const B&) const {
    return std::nullopt;
  }
};

bool changes_nothing(const Edit& edit) {
  if (const auto* move = std::get_if<Move>(&edit.operation)) return move->by.isZero(0);
  if (const auto* turn = std::get_if<Rotate>(&edit.operation)) return turn->radians == 0;
  return std::get<Scale>(edit.operation).factor == 1;
}

/// An edit with the number of the one that it stands for.
struct NumberedEdit {
  Edit edit;
  std::size_t first = 0;
};

std::vector<NumberedEdit> merged_numbered(const std::vector<Edit>& edits) {
  std::vector<NumberedEdit> result;
  for (std::size_t k = 0; k < edits.size(); ++k) {
    if (changes_nothing(edits[k])) continue;
    const auto taken = std::find_if(result.begin(), result.end(), [&](NumberedEdit& other) {
      if (!(other.edit.handle == edits[k].handle) || other.edit.falloff != edits[k].falloff) return false;
      std::optional<Operation> both = std::visit(Merge(), other.edit.operation, edits[k].operation);
      if (both) other.edit.operation = std::move(*both);
      return both.has_value();
    });
    if (taken == result.end())
      result.push_back({edits[k], k});
    else if (changes_nothing(taken->edit))
      result.erase(taken);
  }
  return result;
}

/// The last word on one candidate: everything checked.
struct Verdict {
  Candidate candidate;
  bool reached = false;
};

/// One refinement.
class Refiner {
 public:
  Refiner(const RequirementChecker& checker, const Candidate& start, const RefinementOptions& options)
      : checker_(checker),
        start_(start),
        options_(options),
        edits_(merged_numbered(start.design.edits)),
        direction_(start.direction),
        meter_(checker.space().rest(), checker.requirements().measure.boxes, options.alpha),
        problem_(checker, plain(edits_), direction_,
                 {options.evaluations, options.reach, options.cancelled}) {}

  RefinementResult result() {
    const Verdict given = judged(start_.design, start_.reasons);
    Verdict best = given;
    const Magnitudes found(edits_.size(), 1);
    if (!edits_.empty() && problem_.at(found).made) {
      search(found);
      for (const Magnitudes& x : finalists()) {
        Verdict verdict = judged(x);
        const bool better = verdict.reached != best.reached ? verdict.reached
                            : best.reached                  ? distortion(verdict) < distortion(best)
                                                            : stackability(verdict) > stackability(best);
        if (better) best = std::move(verdict);
        if (best.reached) break;
      }
    }
    return {std::move(best.candidate), best.reached, problem_.evaluations()};
  }

 private:
  static std::vector<Edit> plain(const std::vector<NumberedEdit>& edits) {
    std::vector<Edit> result;
    for (const NumberedEdit& numbered : edits) result.push_back(numbered.edit);
    return result;
  }
  static double distortion(const Verdict& verdict) { return verdict.candidate.energy.distortion.total(); }
  static double stackability(const Verdict& verdict) { return verdict.candidate.measured.value; }

  void search(const Magnitudes& found) {
    if (!problem_.at(found).feasible) reach(found);
    if (!problem_.best()) return;
    pull_back();
    descend();
    leave_out();
    pull_back();
  }

  /// Phase 1: any feasible point.
  void reach(const Magnitudes& found) {
    std::vector<Magnitudes> larger;
    for (const double factor : multiples)
      if (factor <= options_.reach) larger.emplace_back(found.size(), factor);
    problem_.prepare(larger);
    double radius = problem_.highest() - problem_.lowest();
    for (int run = 0; run < most_runs && radius >= least_radius && !problem_.best(); ++run) {
      if (problem_.stopped()) return;
      const Magnitudes from = problem_.nearest().value_or(found);
      const double before = problem_.nearest_stackability();
      problem_.constrain_pairs(from);
      optimised_magnitudes(problem_, {from, radius, MagnitudeGoal::feasible});
      if (problem_.nearest_stackability() - before < least_progress * (1 - before)) radius *= less_far;
    }
  }

  /// Phase 2.
  void descend() {
    double radius = problem_.highest() - problem_.lowest();
    for (int run = 0; run < most_runs && radius >= least_radius && !problem_.stopped(); ++run) {
      const Magnitudes from = *problem_.best();
      const double before = problem_.best_distortion();
      problem_.constrain_pairs(from);
      const MagnitudeRunEnd end = optimised_magnitudes(problem_, {from, radius, MagnitudeGoal::unchanged});
      const bool blocked = end.refused || problem_.at(end.end).stackability < problem_.aim() - least_progress;
      approach(end.end);
      if (problem_.best_distortion() < before * (1 - least_progress)) continue;
      if (!blocked) return;
      radius *= less_far;
    }
  }

  /// Looks for the last feasible point on the way from the best one to `to`, if that promises less D.
  void approach(const Magnitudes& to) {
    const Magnitudes from = *problem_.best();
    const MagnitudeSample there = problem_.at(to);
    if (there.feasible || (there.made && there.distortion >= problem_.best_distortion())) return;
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
      return sample.feasible ? above : std::min(above, -target_tolerance);
    };
    const auto close_enough = [&](double a, double b) {
      return excess <= target_tolerance / 2 || std::abs(b - a) <= tolerance::rounding || problem_.stopped();
    };
    const double at_start = margin(0), at_end = margin(1);
    if (!(at_start > 0) || !(at_end < 0)) return;
    std::uintmax_t steps = most_steps;
    boost::math::tools::toms748_solve(margin, 0.0, 1.0, at_start, at_end, close_enough, steps);
  }

  /// Towards the shape at rest as far as the target allows.
  void pull_back() { approach(Magnitudes(edits_.size(), 0)); }

  /// Tries without the edits that do next to nothing.
  void leave_out() {
    for (std::size_t k = 0; k < edits_.size() && !problem_.stopped(); ++k) {
      Magnitudes x = *problem_.best();
      if (x[k] == 0 || std::abs(x[k]) >= options_.negligible) continue;
      x[k] = 0;
      problem_.at(x);
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
      if (x[k] != 0 && edits_[k].first < start_.reasons.size())
        reasons.push_back(start_.reasons[edits_[k].first]);
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
    return verdict;
  }

  const RequirementChecker& checker_;
  const Candidate& start_;
  const RefinementOptions& options_;
  std::vector<NumberedEdit> edits_;
  Direction direction_;
  EnergyMeter meter_;
  MagnitudeProblem problem_;
};

}  // namespace

Edit with_magnitude(Edit edit, double x) {
  if (auto* move = std::get_if<Move>(&edit.operation))
    move->by *= x;
  else if (auto* turn = std::get_if<Rotate>(&edit.operation))
    turn->radians *= x;
  else {
    auto& scale = std::get<Scale>(edit.operation);
    if (x != 1) scale.factor = std::pow(scale.factor, x);
  }
  return edit;
}

std::vector<Edit> merged(const std::vector<Edit>& edits) {
  std::vector<Edit> result;
  for (const NumberedEdit& numbered : merged_numbered(edits)) result.push_back(numbered.edit);
  return result;
}

RefinementResult refined_candidate(const RequirementChecker& checker, const Candidate& start,
                                   const RefinementOptions& options) {
  if (options.evaluations < 10) throw UsageError("a refinement needs at least 10 evaluations");
  if (!(options.reach > 0) || !std::isfinite(options.reach))
    throw UsageError("the reach of a refinement must be a positive number");
  if (!(options.negligible >= 0)) throw UsageError("the negligible magnitude must not be negative");
  return Refiner(checker, start, options).result();
}

}  // namespace stackabilization
