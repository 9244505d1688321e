#include "stackabilization/improvement/refinement.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "improvement/refinement/magnitude_refiner.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

using namespace detail;

/// Edits are added in rounds, few at a time: every variable costs a sample per slope. The last round is the
/// one that lessens what S lacks, or the change, by less than a fraction of it.
struct RoundLimits {
  int rounds;
  double min_decrease;
};
constexpr RoundLimits reaching_rounds = {8, 1.0 / 50}, lessening_rounds = {4, 1.0 / 100};
/// Designs measured to make up for one edit that is dropped. Where as few edits as this are left, one that
/// cannot be dropped ends the dropping; so do as many edits made as this, all designs measured together.
constexpr int evaluations_per_drop = 80;
constexpr std::int64_t max_edits_made = 40000;
constexpr std::size_t max_edits_to_drop = 6;
/// Largest number of times that a result with fewer edits is refined again.
constexpr int max_restarts = 3;

/// Returns all edits that can be added to a candidate.
std::vector<MagnitudeEdit> every_edit(const RequirementChecker& checker, const Candidate& candidate,
                                      const RefinementOptions& options) {
  std::vector<MagnitudeEdit> given;
  for (std::size_t k = 0; k < candidate.design.edits.size(); ++k)
    given.push_back({candidate.design.edits[k], k});
  return possible_edits(given, checker.space(), Direction(candidate.direction), options.family);
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

/// Refinement of a candidate: rounds of magnitudes, edits that join, and edits that are dropped.
class CandidateRefinement {
 public:
  CandidateRefinement(const RequirementChecker& checker, const Candidate& start,
                      const RefinementOptions& options)
      : checker_(checker),
        start_(start),
        options_(options),
        result_(MagnitudeRefiner(checker, start, options).result()) {}

  RefinementResult run() {
    if (options_.reach_with_added) add_edits(MagnitudeGoal::feasible, reaching_rounds);
    refine_shorter_lists();
    if (options_.max_added_edits > 0) add_edits(MagnitudeGoal::min_change, lessening_rounds);
    if (options_.edit_price > 0 && result_.reached) drop_singly();
    return std::move(result_);
  }

 private:
  bool cancelled() const { return options_.cancelled && options_.cancelled(); }
  double change() const {
    return size_of(options_.objective, result_.candidate, checker_.space().rest().shape);
  }
  double lacking() const { return checker_.requirements().target - result_.candidate.measured.value; }

  RefinementOptions options_left() const {
    RefinementOptions left = options_;
    left.evaluations -= result_.evaluations;
    return left;
  }
  bool can_go_on() const { return options_left().evaluations >= min_refinement_evaluations && !cancelled(); }

  /// Refines the best candidate together with edits that are added.
  void refine(const std::vector<MagnitudeEdit>& added) {
    RefinementResult next = MagnitudeRefiner(checker_, result_.candidate, options_left(), added).result();
    next.evaluations += result_.evaluations;
    result_ = std::move(next);
  }

  std::vector<MagnitudeEdit> offered(MagnitudeGoal goal) {
    const RefinementOptions left = options_left();
    MagnitudeRefiner all(checker_, result_.candidate, left,
                         every_edit(checker_, result_.candidate, options_));
    std::vector<MagnitudeEdit> edits =
        all.promising(goal, static_cast<std::size_t>(options_.max_added_edits));
    result_.evaluations += all.evaluations();
    return edits;
  }

  /// Adds edits in rounds: to reach the target until it is reached, or else to lessen the change.
  void add_edits(MagnitudeGoal goal, const RoundLimits& limits) {
    const bool reaching = goal == MagnitudeGoal::feasible;
    const auto remaining = [&] { return reaching ? lacking() : change(); };
    for (int round = 0; round < limits.rounds && result_.reached != reaching && can_go_on(); ++round) {
      const double before = remaining();
      const std::vector<MagnitudeEdit> added = offered(goal);
      if (added.empty() || !can_go_on()) return;
      refine(added);
      if (!(remaining() < before * (1 - limits.min_decrease))) return;
    }
  }

  /// Refines lists again that have become shorter.
  void refine_shorter_lists() {
    std::size_t edits = start_.design.edits.size();
    for (int restart = 0; restart < max_restarts && result_.reached && can_go_on(); ++restart) {
      if (result_.candidate.design.edits.size() >= edits) return;
      edits = result_.candidate.design.edits.size();
      refine({});
    }
  }

  /// Drops edits one after the other, those of least effect first, and refines the others to make up for it,
  /// as long as the change grows by no more than the price of an edit.
  void drop_singly() {
    while (drop_one()) {
    }
  }

  /// Returns whether an edit was dropped.
  bool drop_one() {
    RefinementOptions one = options_;
    one.evaluations = evaluations_per_drop;
    const double allowed = change() * (1 + options_.edit_price);
    for (auto& [k, design] : by_effect(checker_, result_.candidate)) {
      if (edits_made_ >= max_edits_made || cancelled()) return false;
      Candidate fewer = result_.candidate;
      fewer.design = std::move(design);
      if (k < fewer.reasons.size())
        fewer.reasons.erase(fewer.reasons.begin() + static_cast<std::ptrdiff_t>(k));
      RefinementResult next = MagnitudeRefiner(checker_, fewer, one).result();
      result_.evaluations += next.evaluations;
      edits_made_ += next.evaluations * static_cast<std::int64_t>(fewer.design.edits.size());
      const double changed = size_of(options_.objective, next.candidate, checker_.space().rest().shape);
      if (next.reached && changed <= allowed) {
        result_.candidate = std::move(next.candidate);
        return true;
      }
      if (result_.candidate.design.edits.size() <= max_edits_to_drop) return false;
    }
    return false;
  }

  const RequirementChecker& checker_;
  const Candidate& start_;
  const RefinementOptions& options_;
  RefinementResult result_;
  std::int64_t edits_made_ = 0;  ///< in order to drop edits, over all designs
};

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
  return CandidateRefinement(checker, start, options).run();
}

}  // namespace stackabilization
