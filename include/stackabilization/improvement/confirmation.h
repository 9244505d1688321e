#pragma once

#include <string>
#include <vector>

#include "stackabilization/improvement/requirements.h"
#include "stackabilization/stacking/validation.h"

namespace stackabilization {

/// A question asked of the mesh of a design, and the answer.
struct Confirmation {
  Verdict verdict = Verdict::agrees;  ///< `agrees`, `skipped` or `disagrees`
  std::string name;                   ///< what is compared
  std::string note;                   ///< what was found, or why the question was not asked
};

/// Asks a mesh whether it is the design that an assessment belongs to, for instance one that was read again
/// from the file that the design was written to: S and, where it has to be kept, the height within
/// tolerance::relative; f_max the same rational number; and collision tests just above, at and just below
/// f_max (collision_probes.h), which share no code with the separation. The collision tests are skipped
/// beyond ValidationOptions::max_collision_triangles, and ask of surfaces only where the mesh has no
/// interior.
///
/// `said`: what RequirementChecker::check returned for the design along `direction`. Throws InputError for a
/// mesh without volume.
std::vector<Confirmation> confirm(const RequirementChecker& checker, const Shape& mesh,
                                  const Direction& direction, const Assessment& said);

}  // namespace stackabilization
