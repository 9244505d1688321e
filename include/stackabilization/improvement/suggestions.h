#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "stackabilization/improvement/contact_edits.h"
#include "stackabilization/improvement/energy.h"
#include "stackabilization/improvement/requirements.h"

namespace stackabilization {

/// An edit that the contacts of a design suggest, with its effect.
struct Suggestion {
  ContactEdit edit;  ///< the edit and its reason
  /// Why the edit cannot be made: the model refuses it, it changes nothing, the design would violate a
  /// requirement (the first one; the target does not count, a room does), or S or D would be undefined. When
  /// set, `measured` and `energy` are meaningless.
  std::optional<Obstacle> refusal;
  Stackability measured;  ///< S(M, r) after the edit, exact, with clearance and play
  Energy energy;          ///< E after the edit, against the shape at rest
  /// Summed gap excess after the edit, see Situation. Set with SuggestionOptions::only_helpful.
  double excess = 0;
  /// Whether `measured` reaches the target of the requirements; false where a room replaces the target.
  bool reaches_target = false;
};

/// Options of `suggestions` and `situation`.
struct SuggestionOptions {
  double alpha = 0.2;        ///< weight of D in Eq. 5, in [0, 1]
  ContactEditOptions edits;  ///< edits that contacts suggest
  /// Leaves out edits that neither raise S nor lower the summed gap excess, and orders those that can be made
  /// by D + F / F_now, least first, with F_now of `design`: where several contacts block at the same height,
  /// an edit that moves only one of them out of the way comes before edits that help nothing.
  bool only_helpful = false;
  /// Called from the calling thread with all suggestions so far, in order, whenever there are more.
  std::function<void(const std::vector<Suggestion>&)> found = {};
  std::function<void(double)> progress = {};  ///< called from the calling thread with the share that is done
  std::function<bool()> cancelled = {};       ///< asked from any thread; true ends the list with those so far
};

/// Measures and contacts of a design stacked on itself: the basis of the next step.
struct Situation {
  Stackability measured;  ///< S(M, r), exact, with clearance and play
  Energy energy;          ///< E against the shape at rest
  /// Contact regions without clearance and play; none when nothing touches.
  std::vector<ContactRegion> contacts;
  /// Summed gap excess F: by how much all pairs of parts that touch keep the copies farther apart than the
  /// target allows, over the extent; 0 where the target is reached.
  double excess = 0;
};

/// Measures a design along `direction` and finds its contacts. Precondition: `design` belongs to the
/// checker's space. Throws UsageError for an alpha out of [0, 1].
Situation situation(const RequirementChecker& checker, const Design& design, const Direction& direction,
                    const SuggestionOptions& options = {});

/// Lists the edits for one interactive step (section 5 of the paper): every edit that the contacts of
/// `design` along `direction` suggest (contact_edits.h), made and measured along the same direction. Gains
/// are against the shape at rest along that direction. Order: edits that can be made first, least E first
/// (ties: in the order of contact_edits), then refused edits; with `only_helpful` another one.
///
/// Each edit is made under `deformation_constraints(checker.requirements(), rest, direction)`, so
/// `checker.space().edited(design, suggestion.edit.edit, constraints)` gives its design. The result is the
/// same for any number of threads. Precondition: `design` belongs to the checker's space. Throws UsageError
/// for options out of range.
std::vector<Suggestion> suggestions(const RequirementChecker& checker, const Design& design,
                                    const Direction& direction, const SuggestionOptions& options = {});

}  // namespace stackabilization
