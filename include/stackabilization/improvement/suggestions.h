#pragma once

#include <optional>
#include <string>
#include <vector>

#include "stackabilization/improvement/contact_edits.h"
#include "stackabilization/improvement/energy.h"
#include "stackabilization/improvement/requirements.h"

namespace stackabilization {

/// One edit that the contacts of a design suggest, and what it would do.
struct Suggestion {
  ContactEdit edit;  ///< what to do, and why
  /// Why it cannot be made: the refusal of the model, that nothing would change, or the first requirement,
  /// other than the target, that the design would break. When set, `measured` and `energy` say nothing.
  std::optional<std::string> refusal;
  Stackability measured;        ///< S(M, r) after the edit, exact, with the air asked for
  Energy energy;                ///< against rest
  bool reaches_target = false;  ///< `measured` is at least the target of the requirements
};

/// Options of `suggestions` and `situation`.
struct SuggestionOptions {
  double alpha = 0.2;        ///< of Eq. 5
  ContactEditOptions edits;  ///< what contacts suggest
};

/// A design stacked on itself, looked at: what the next step starts from.
struct Situation {
  Stackability measured;                ///< S(M, r), exact, with the air asked for
  Energy energy;                        ///< against rest
  std::vector<ContactRegion> contacts;  ///< without air; none when nothing touches
};

/// Precondition: `design` is one of the checker's space. Throws UsageError for an alpha out of [0, 1].
Situation situation(const RequirementChecker& checker, const Design& design, const Direction& direction,
                    const SuggestionOptions& options = {});

/// Everything that can be done to a design in one step (section 5 of the paper, the interactive mode): the
/// edits that its contacts along `direction` suggest (contact_edits.h), each made and measured along the same
/// direction. Gains are against the shape at rest along that direction. Those that can be made come first,
/// least E first (ties: in the order of contact_edits), then the refused ones.
///
/// An edit is made under `deformation_constraints(checker.requirements(), rest, direction)`:
/// `checker.space().edited(design, suggestion.edit.edit, those)` gives its design. The same result for any
/// number of threads. Precondition: `design` is one of the checker's space. Throws UsageError for options out
/// of range.
std::vector<Suggestion> suggestions(const RequirementChecker& checker, const Design& design,
                                    const Direction& direction, const SuggestionOptions& options = {});

}  // namespace stackabilization
