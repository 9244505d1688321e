#include "stackabilization/improvement/refinement.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>

#include "improvement/refinement/edit_magnitudes.h"
#include "improvement/refinement/magnitude_model.h"
#include "improvement/refinement/magnitude_search.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

using namespace detail;

/// Edits are added in rounds, few at a time: every variable costs a sample per slope. They are chosen by
/// reduced cost in a trust region of radius pricing_radius. An edit is added only if its reduced cost per
/// unit of magnitude is above min_reduced_cost times the change. A round that lessens the change by less than
/// the fraction min_gain is the last.
constexpr int max_rounds = 4;
constexpr double pricing_radius = 0.1;
constexpr double min_reduced_cost = 0.01;
constexpr double min_gain = 0.01;
/// The same for rounds that add edits in order to reach the target: their number, and the least fraction of
/// what S lacks that a round has to gain.
constexpr int max_reaching_rounds = 8;
constexpr double min_reached = 0.02;
/// Designs measured to make up for one edit that is dropped. Where as few edits as this are left, one that
/// cannot be dropped ends the dropping; so do as many edits made as this, all designs measured together.
constexpr int evaluations_per_drop = 80;
constexpr std::int64_t max_edits_made = 40000;
constexpr std::size_t max_edits_to_drop = 6;
/// An edit moves the surface in a new way if at least this share of its squared displacement is none that the
/// others can make.
constexpr double new_motion = 0.2;

/// Largest number of times that a result with fewer edits is refined again.
constexpr int max_restarts = 3;

/// A candidate with all checks made.
struct Verdict {
  Candidate candidate;
  bool reached = false;
  double change = 0;
};

/// Refinement of the magnitudes of one list of edits.
class MagnitudeRefiner {
 public:
  /// `added`: edits added to those of the start, with magnitude 0.
  MagnitudeRefiner(const RequirementChecker& checker, const Candidate& start,
                   const RefinementOptions& options, const std::vector<MagnitudeEdit>& added = {})
      : checker_(checker),
        start_(start),
        options_(options),
        direction_(start.direction),
        edits_(variables(checker, start, options, added)),
        meter_(checker.rest_shape().energy_meter().with_alpha(options.alpha)),
        problem_(checker, plain(edits_), direction_,
                 {options.evaluations, options.magnitude_bound, options.objective, options.cancelled}) {}

  /// Returns the added edits of largest reduced cost at the start, at most `most`.
  std::vector<MagnitudeEdit> promising(MagnitudeGoal goal, std::size_t most) {
    const Magnitudes x = found();
    if (x.empty() || !problem_.at(x).made) return {};
    problem_.constrain_pairs(x);
    const MagnitudeSlopes slopes = problem_.slopes(x);
    const MagnitudeModel model(goal, x, problem_.at(x), slopes);
    Magnitudes low = x, high = x;
    for (double& magnitude : low) magnitude -= pricing_radius;
    for (double& magnitude : high) magnitude += pricing_radius;
    const Eigen::VectorXd pulls = model.step(low, high).reduced_costs;
    const double least = min_reduced_cost * model.merit(problem_.at(x));
    std::vector<std::pair<double, std::size_t>> ranked;
    for (std::size_t k = 0; k < edits_.size(); ++k) {
      const double reduced_costs = pulls(static_cast<Eigen::Index>(k));
      if (!edits_[k].source && slopes.made[k] && reduced_costs > least)
        ranked.emplace_back(-reduced_costs, k);
    }
    std::sort(ranked.begin(), ranked.end());
    if (options_.edit_price > 0) leave_out_likes(ranked, slopes.gram);
    if (ranked.size() > most) ranked.resize(most);
    std::vector<MagnitudeEdit> result;
    for (const auto& [reduced_costs, k] : ranked) result.push_back(edits_[k]);
    return result;
  }

  int evaluations() const { return problem_.evaluations(); }

  RefinementResult result() {
    const Verdict given = judged(start_.design, start_.reasons);
    Verdict best = given;
    if (!edits_.empty() && problem_.at(found()).made) {
      search_magnitudes(problem_, found(), options_);
      for (const Magnitudes& x : finalists()) {
        Verdict verdict = judged(x);
        if (better(verdict, best)) best = std::move(verdict);
        if (best.reached) break;
      }
    }
    return {std::move(best.candidate), best.reached, problem_.evaluations()};
  }

 private:
  /// Leaves out edits that move the surface like given ones and those before them do together: the second
  /// face of a part that is symmetric to itself, or the scaling of a part whose faces move.
  void leave_out_likes(std::vector<std::pair<double, std::size_t>>& ranked,
                       const Eigen::MatrixXd& gram) const {
    if (gram.size() == 0) return;
    std::vector<Eigen::Index> chosen;  // columns of `gram`, of which the first is the surface itself
    for (std::size_t k = 0; k < edits_.size(); ++k)
      if (edits_[k].source) chosen.push_back(static_cast<Eigen::Index>(k) + 1);
    std::erase_if(ranked, [&](const auto& entry) {
      const Eigen::Index column = static_cast<Eigen::Index>(entry.second) + 1;
      const Eigen::VectorXd along = gram(chosen, column);
      const Eigen::MatrixXd between = gram(chosen, chosen);
      const double own = gram(column, column);
      const double left =
          chosen.empty() ? own : own - along.dot(between.completeOrthogonalDecomposition().solve(along));
      if (left < new_motion * own) return true;
      chosen.push_back(column);
      return false;
    });
  }

  /// Returns the given edits and the added ones. Given edits are merged unless the merged list is refused.
  static std::vector<MagnitudeEdit> variables(const RequirementChecker& checker, const Candidate& start,
                                              const RefinementOptions& options,
                                              const std::vector<MagnitudeEdit>& added) {
    const DeformationConstraints constraints =
        deformation_constraints(checker.requirements(), checker.space().rest(), Direction(start.direction));
    std::vector<MagnitudeEdit> edits =
        merge_magnitude_edits(start.design.edits, [&](const std::vector<MagnitudeEdit>& fewer) {
          const bool late = options.cancelled && options.cancelled();  // replaying long lists is slow
          return !late && !checker.space().deformed(plain(fewer), constraints).refusal;
        });
    edits.insert(edits.end(), added.begin(), added.end());
    return edits;
  }
  static std::vector<Edit> plain(const std::vector<MagnitudeEdit>& edits) {
    std::vector<Edit> result;
    for (const MagnitudeEdit& one : edits) result.push_back(one.edit);
    return result;
  }
  /// Returns the magnitudes of the start: 1 for given edits, 0 for added ones.
  Magnitudes found() const {
    Magnitudes x;
    for (const MagnitudeEdit& one : edits_) x.push_back(one.source ? 1 : 0);
    return x;
  }
  static double stackability(const Verdict& verdict) { return verdict.candidate.measured.value; }
  /// Of equal changes the one with fewer edits is better.
  static bool better(const Verdict& a, const Verdict& b) {
    if (a.reached != b.reached) return a.reached;
    if (!a.reached) return stackability(a) > stackability(b);
    return std::pair(a.change, a.candidate.design.edits.size()) <
           std::pair(b.change, b.candidate.design.edits.size());
  }

  /// Returns the points worth a full check.
  std::vector<Magnitudes> finalists() const {
    std::vector<Magnitudes> result;
    if (problem_.best()) result.push_back(*problem_.best());
    if (!problem_.best() && problem_.nearest()) result.push_back(*problem_.nearest());
    return result;
  }

  Verdict judged(const Magnitudes& x) const {
    std::vector<EditReason> reasons;
    for (std::size_t k = 0; k < edits_.size(); ++k)
      if (x[k] != 0)
        reasons.push_back(edits_[k].source && *edits_[k].source < start_.reasons.size()
                              ? start_.reasons[*edits_[k].source]
                              : EditReason{EditEffect::compensation});
    return judged(problem_.design(x).design, std::move(reasons));
  }

  Verdict judged(Design design, std::vector<EditReason> reasons) const {
    Verdict verdict;
    const Assessment assessment = checker_.check(design, direction_);
    Candidate& candidate = verdict.candidate;
    candidate.measured = assessment.measured;
    const double gain = start_.energy.gain + assessment.measured.value - start_.measured.value;
    candidate.energy = meter_.energy(design, gain);
    candidate.design = std::move(design);
    candidate.direction = start_.direction;
    candidate.reasons = std::move(reasons);
    verdict.reached = assessment.passed();
    verdict.change = size_of(options_.objective, candidate, checker_.space().rest().shape);
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

/// Edits worth adding, and the evaluations used to find them.
struct Offer {
  std::vector<MagnitudeEdit> edits;
  int evaluations = 0;
};

/// Returns all edits that can be added to a candidate.
std::vector<MagnitudeEdit> every_edit(const RequirementChecker& checker, const Candidate& candidate,
                                      const RefinementOptions& options) {
  std::vector<MagnitudeEdit> given;
  for (std::size_t k = 0; k < candidate.design.edits.size(); ++k)
    given.push_back({candidate.design.edits[k], k});
  return possible_edits(given, checker.space(), Direction(candidate.direction), options.family);
}

Offer offered(const RequirementChecker& checker, const Candidate& candidate, const RefinementOptions& options,
              MagnitudeGoal goal) {
  MagnitudeRefiner all(checker, candidate, options, every_edit(checker, candidate, options));
  Offer offer;
  offer.edits = all.promising(goal, static_cast<std::size_t>(options.max_added_edits));
  offer.evaluations = all.evaluations();
  return offer;
}

/// Returns the edits of a candidate from the one that moves the surface least to the one that moves it most,
/// each with the design without it. Edits that others cannot be made without are left out.
std::vector<std::pair<std::size_t, Design>> by_effect(const RequirementChecker& checker,
                                                      const Candidate& candidate) {
  const DeformationConstraints constraints =
      deformation_constraints(checker.requirements(), checker.space().rest(), Direction(candidate.direction));
  std::vector<std::pair<double, std::pair<std::size_t, Design>>> effects;
  for (std::size_t k = 0; k < candidate.design.edits.size(); ++k) {
    std::vector<Edit> fewer = candidate.design.edits;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
    DeformationResult without = checker.space().deformed(fewer, constraints);
    if (without.refusal) continue;
    const double effect = (without.design.shape.vertices - candidate.design.shape.vertices).norm();
    effects.emplace_back(effect, std::pair(k, std::move(without.design)));
  }
  std::stable_sort(effects.begin(), effects.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::pair<std::size_t, Design>> result;
  for (auto& [effect, entry] : effects) result.push_back(std::move(entry));
  return result;
}

/// Drops edits one after the other, those of least effect first, and refines the others to make up for it, as
/// long as the change grows by no more than the price of an edit.
void drop_singly(const RequirementChecker& checker, const RefinementOptions& options,
                 RefinementResult& result) {
  const Shape& rest = checker.space().rest().shape;
  RefinementOptions one = options;
  one.evaluations = evaluations_per_drop;
  std::int64_t made = 0;
  for (bool dropped = true; dropped;) {
    dropped = false;
    for (auto& [k, design] : by_effect(checker, result.candidate)) {
      if (made >= max_edits_made || (options.cancelled && options.cancelled())) return;
      Candidate fewer = result.candidate;
      fewer.design = std::move(design);
      if (k < fewer.reasons.size())
        fewer.reasons.erase(fewer.reasons.begin() + static_cast<std::ptrdiff_t>(k));
      RefinementResult next = MagnitudeRefiner(checker, fewer, one).result();
      result.evaluations += next.evaluations;
      made += next.evaluations * static_cast<std::int64_t>(fewer.design.edits.size());
      const double allowed = size_of(options.objective, result.candidate, rest) * (1 + options.edit_price);
      if (!next.reached || size_of(options.objective, next.candidate, rest) > allowed) {
        if (result.candidate.design.edits.size() <= max_edits_to_drop) break;
        continue;
      }
      result.candidate = std::move(next.candidate);
      dropped = true;
      break;
    }
  }
}

}  // namespace

RefinementResult refine_candidate(const RequirementChecker& checker, const Candidate& start,
                                  const RefinementOptions& options) {
  if (options.evaluations < min_refinement_evaluations)
    throw UsageError("a refinement needs at least " + std::to_string(min_refinement_evaluations) +
                     " evaluations");
  if (!(options.magnitude_bound > 0) || !std::isfinite(options.magnitude_bound))
    throw UsageError("the reach of a refinement must be a positive number");
  if (options.max_added_edits < 0) throw UsageError("the number of edits that join must not be negative");
  if (!(options.edit_price >= 0)) throw UsageError("the price of an edit must not be negative");
  if (!(options.drop_threshold >= 0)) throw UsageError("the negligible magnitude must not be negative");
  RefinementResult result = MagnitudeRefiner(checker, start, options).result();
  const auto options_left = [&] {
    RefinementOptions left = options;
    left.evaluations -= result.evaluations;
    return left;
  };
  const auto can_go_on = [&] {
    return options_left().evaluations >= min_refinement_evaluations &&
           !(options.cancelled && options.cancelled());
  };
  const auto goes_on = [&] { return result.reached && can_go_on(); };
  const auto tries_on = [&] { return !result.reached && can_go_on(); };
  const auto take = [&](RefinementResult next) {
    next.evaluations += result.evaluations;
    result = std::move(next);
  };
  const double target = checker.requirements().target;
  const auto lacking = [&] { return target - result.candidate.measured.value; };
  for (int round = 0; options.reach_with_added && round < max_reaching_rounds && tries_on(); ++round) {
    const double before = lacking();
    const Offer offer = offered(checker, result.candidate, options_left(), MagnitudeGoal::feasible);
    result.evaluations += offer.evaluations;
    if (offer.edits.empty() || !tries_on()) break;
    take(MagnitudeRefiner(checker, result.candidate, options_left(), offer.edits).result());
    if (!(lacking() < before * (1 - min_reached))) break;
  }
  std::size_t edits = start.design.edits.size();
  for (int restart = 0; restart < max_restarts && goes_on(); ++restart) {
    if (result.candidate.design.edits.size() >= edits) break;
    edits = result.candidate.design.edits.size();
    take(MagnitudeRefiner(checker, result.candidate, options_left()).result());
  }
  const Shape& rest = checker.space().rest().shape;
  for (int round = 0; options.max_added_edits > 0 && round < max_rounds && goes_on(); ++round) {
    const double before = size_of(options.objective, result.candidate, rest);
    const Offer offer = offered(checker, result.candidate, options_left(), MagnitudeGoal::min_change);
    result.evaluations += offer.evaluations;
    if (offer.edits.empty() || !goes_on()) break;
    take(MagnitudeRefiner(checker, result.candidate, options_left(), offer.edits).result());
    if (!(size_of(options.objective, result.candidate, rest) < before * (1 - min_gain))) break;
  }
  if (options.edit_price > 0 && result.reached) drop_singly(checker, options, result);
  return result;
}

}  // namespace stackabilization
