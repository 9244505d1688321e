#include "stackabilization/improvement/suggestions.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "improvement/contacts/design_contacts.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization {

namespace {

/// Measures and checks designs along one direction.
class SuggestionScorer {
 public:
  SuggestionScorer(const RequirementChecker& checker, const Direction& direction, double alpha)
      : checker_(checker),
        direction_(direction),
        meter_(checker.rest_shape().energy_meter().with_alpha(alpha)),
        constraints_(deformation_constraints(checker.requirements(), checker.space().rest(), direction)),
        at_rest_(checker.check(checker.space().at_rest(), direction).measured.value) {}

  Energy energy(const Design& design, const Stackability& measured) const {
    return meter_.energy(design, measured.value - at_rest_);
  }

  /// Fills in the effect of `suggestion.edit` on `design`.
  void scorer(Suggestion& suggestion, const Design& design) const {
    const DeformationResult outcome = checker_.space().edited(design, suggestion.edit.edit, constraints_);
    if (outcome.refusal) {
      suggestion.refusal = *outcome.refusal;
      return;
    }
    const double moved = (outcome.design.shape.vertices - design.shape.vertices).cwiseAbs().maxCoeff();
    if (moved <= tolerance::relative * checker_.space().rest().structure.diagonal) {
      suggestion.refusal = Refusal{RefusalCause::unchanged};
      return;
    }
    const Assessment assessment = checker_.check(outcome.design, direction_);
    for (const Check& check : assessment.checks)
      if (check.kind == CheckKind::target)
        suggestion.reaches_target = check.passed;
      else if (!check.passed && !suggestion.refusal)
        suggestion.refusal = check;
    if (suggestion.refusal) return;
    suggestion.measured = assessment.measured;
    suggestion.energy = energy(outcome.design, assessment.measured);
    if (!std::isfinite(suggestion.energy.value)) suggestion.refusal = Refusal{RefusalCause::undefined};
  }

 private:
  const RequirementChecker& checker_;
  const Direction& direction_;
  EnergyMeter meter_;
  DeformationConstraints constraints_;
  double at_rest_;  ///< S of the shape at rest along the direction
};

}  // namespace

Situation situation(const RequirementChecker& checker, const Design& design, const Direction& direction,
                    const SuggestionOptions& options) {
  Situation result;
  result.measured = checker.check(design, direction).measured;
  result.energy = SuggestionScorer(checker, direction, options.alpha).energy(design, result.measured);
  result.contacts = detail::contacts_of(checker, design.shape, direction, options.edits.contacts);
  return result;
}

std::vector<Suggestion> suggestions(const RequirementChecker& checker, const Design& design,
                                    const Direction& direction, const SuggestionOptions& options) {
  const DeformationModel& space = checker.space();
  const std::vector<ContactRegion> regions =
      detail::contacts_of(checker, design.shape, direction, options.edits.contacts);
  const std::vector<Handle> handles = space.handles();
  const std::vector<ContactEdit> edits = contact_edits(
      {space.rest(), space.capabilities(), handles, design, regions, direction, space.centres()},
      options.edits);
  const SuggestionScorer scorer(checker, direction, options.alpha);
  std::vector<Suggestion> result(edits.size());
  tbb::parallel_for(std::size_t{0}, edits.size(), [&](std::size_t k) {
    result[k].edit = edits[k];
    scorer.scorer(result[k], design);
  });
  std::stable_sort(result.begin(), result.end(), [](const Suggestion& a, const Suggestion& b) {
    if (a.refusal.has_value() != b.refusal.has_value()) return b.refusal.has_value();
    return !a.refusal && a.energy.value < b.energy.value;
  });
  return result;
}

}  // namespace stackabilization
