#include "stackabilization/improvement/suggestions.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "improvement/contacts/design_contacts.h"
#include "improvement/contacts/gap_excess.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization {

namespace {

/// Edits that are tried before the list is shown again.
constexpr std::size_t suggestion_batch = 16;
/// Decrease of the summed gap excess that makes an edit helpful, fraction of it.
constexpr double min_suggested_relief = 0.01;
/// Increase of S that makes an edit helpful.
constexpr double min_suggested_gain = 0.001;

Stackability exact_at_rest(const RequirementChecker& checker, const Direction& direction) {
  const RestShape& rest = checker.rest_shape();
  return measure_exact(rest.shape(), rest.solver_without_play().tree(), direction, rest.options())
      .stackability;
}

/// Measures and checks designs along one direction.
class SuggestionScorer {
 public:
  SuggestionScorer(const RequirementChecker& checker, const Direction& direction, double alpha)
      : checker_(checker),
        direction_(direction),
        meter_(checker.rest_shape().energy_meter().with_alpha(alpha)),
        constraints_(deformation_constraints(checker.requirements(), checker.space().rest(), direction)),
        at_rest_(exact_at_rest(checker, direction).value),
        gap_(checker, direction) {}

  Energy energy(const Design& design, const Stackability& measured) const {
    return meter_.energy(design, measured.value - at_rest_);
  }

  double excess(const Shape& shape, const Stackability& measured) const {
    return gap_.of(shape, measured).equal;
  }

  /// Fills in the effect of `suggestion.edit` on `design`.
  void score(Suggestion& suggestion, const Design& design) const {
    if (const std::optional<Design> edited = design_after(suggestion, design)) check(suggestion, *edited);
  }

  /// Does the same if the edit helps a design with these measures; otherwise returns false.
  bool score_helpful(Suggestion& suggestion, const Design& design, const Situation& now) const {
    const std::optional<Design> edited = design_after(suggestion, design);
    if (!edited) return true;
    const Stackability measured = checker_.measure(edited->shape, direction_);
    suggestion.excess = excess(edited->shape, measured);
    if (measured.value < now.measured.value + min_suggested_gain &&
        suggestion.excess >= (1 - min_suggested_relief) * now.excess)
      return false;
    if (const std::optional<Obstacle> obstacle = checker_.form_obstacle(*edited))
      suggestion.refusal = obstacle;
    else
      check(suggestion, *edited);
    return true;
  }

 private:
  std::optional<Design> design_after(Suggestion& suggestion, const Design& design) const {
    DeformationResult outcome = checker_.space().edited(design, suggestion.edit.edit, constraints_);
    if (outcome.refusal) {
      suggestion.refusal = *outcome.refusal;
      return std::nullopt;
    }
    const double moved = (outcome.design.shape.vertices - design.shape.vertices).cwiseAbs().maxCoeff();
    if (moved <= tolerance::relative * checker_.space().rest().structure.diagonal) {
      suggestion.refusal = Refusal{RefusalCause::unchanged};
      return std::nullopt;
    }
    return std::move(outcome.design);
  }

  void check(Suggestion& suggestion, const Design& edited) const {
    const Assessment assessment = checker_.check(edited, direction_);
    for (const Check& check : assessment.checks)
      if (check.is_of_target())
        suggestion.reaches_target = check.passed;
      else if (!check.passed && !suggestion.refusal)
        suggestion.refusal = check;
    if (suggestion.refusal) return;
    suggestion.measured = assessment.measured;
    suggestion.energy = energy(edited, assessment.measured);
    if (!std::isfinite(suggestion.energy.value)) suggestion.refusal = Refusal{RefusalCause::undefined};
  }

  const RequirementChecker& checker_;
  const Direction& direction_;
  EnergyMeter meter_;
  DeformationConstraints constraints_;
  double at_rest_;  ///< S of the shape at rest along the direction
  detail::GapExcess gap_;
};

Situation situation_of(const RequirementChecker& checker, const SuggestionScorer& scorer,
                       const Design& design, const Direction& direction, const SuggestionOptions& options) {
  Situation result;
  detail::MeasuredContacts touching =
      detail::measured_contacts(checker, design.shape, direction, options.edits.contacts);
  result.measured = touching.measured;
  result.energy = scorer.energy(design, result.measured);
  result.contacts = std::move(touching.regions);
  result.excess = scorer.excess(design.shape, result.measured);
  return result;
}

/// Sorts suggestions that can be made by `merit`, least first, before those that are refused.
template <class Merit>
void sort_by(std::vector<Suggestion>& list, const Merit& merit) {
  std::stable_sort(list.begin(), list.end(), [&](const Suggestion& a, const Suggestion& b) {
    if (a.refusal.has_value() != b.refusal.has_value()) return b.refusal.has_value();
    return !a.refusal && merit(a) < merit(b);
  });
}

void sort_suggestions(std::vector<Suggestion>& list, const Situation& now, const SuggestionOptions& options) {
  if (options.only_helpful && now.excess > 0)
    sort_by(list,
            [&](const Suggestion& one) { return one.energy.distortion.total() + one.excess / now.excess; });
  else
    sort_by(list, [](const Suggestion& one) { return one.energy.value; });
}

}  // namespace

Situation situation(const RequirementChecker& checker, const Design& design, const Direction& direction,
                    const SuggestionOptions& options) {
  return situation_of(checker, SuggestionScorer(checker, direction, options.alpha), design, direction,
                      options);
}

std::vector<Suggestion> suggestions(const RequirementChecker& checker, const Design& design,
                                    const Direction& direction, const SuggestionOptions& options) {
  const DeformationModel& space = checker.space();
  const SuggestionScorer scorer(checker, direction, options.alpha);
  const Situation now = situation_of(checker, scorer, design, direction, options);
  const std::vector<Handle> handles = space.handles();
  const std::vector<ContactEdit> edits = contact_edits(
      {space.rest(), space.capabilities(), handles, design, now.contacts, direction, space.centres()},
      options.edits);
  std::vector<Suggestion> result;
  for (std::size_t begin = 0; begin < edits.size(); begin += suggestion_batch) {
    if (options.cancelled && options.cancelled()) break;
    const std::size_t end = std::min(begin + suggestion_batch, edits.size());
    std::vector<std::optional<Suggestion>> batch(end - begin);
    tbb::parallel_for(begin, end, [&](std::size_t k) {
      if (options.cancelled && options.cancelled()) return;
      Suggestion suggestion;
      suggestion.edit = edits[k];
      if (!options.only_helpful)
        scorer.score(suggestion, design);
      else if (!scorer.score_helpful(suggestion, design, now))
        return;
      batch[k - begin] = std::move(suggestion);
    });
    for (std::optional<Suggestion>& one : batch)
      if (one) result.push_back(std::move(*one));
    sort_suggestions(result, now, options);
    if (options.found) options.found(result);
    if (options.progress) options.progress(static_cast<double>(end) / static_cast<double>(edits.size()));
  }
  return result;
}

}  // namespace stackabilization
