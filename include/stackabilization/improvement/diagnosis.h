#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/improvement/best_first.h"

namespace stackabilization {

/// A pair of contact regions that prevents a larger S.
struct Blocker {
  int upper_part = -1, lower_part = -1;  ///< parts of the copies below and above, rows of Structure::parts
  ContactType type = ContactType::dot;   ///< type of the region
  /// Exact separation of the two parts alone along r, model units, without clearance and play. f_max of the
  /// design where the two parts alone pass each other.
  double f = 0;
  double stackability = 0;  ///< S if this pair were the only obstacle, Eq. 3 with `f`
  /// Why the edits that would separate the pair were refused, or did not raise S. Empty where no edit was
  /// tried.
  std::string reason;
};

/// A change that would raise S.
struct Remedy {
  /// Kinds of changes: stack along another direction, let a part change, leave a part out, relax a
  /// requirement (height or box).
  enum class Kind { other_direction, free_part, remove_part, relax };
  Kind kind = Kind::relax;  ///< kind of the change
  std::string what;         ///< the change as an imperative clause, for people
  std::vector<int> parts;   ///< parts to be freed or left out; rows of Structure::parts
  /// r along which `stackability` is measured; the new direction for other_direction.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  /// S(M, r) with the change. other_direction and remove_part: of the shape at rest, without further edits.
  /// free_part and relax: after the best single edit of the design that the change allows.
  double stackability = 0;
};

/// Why a target was not reached.
struct Diagnosis {
  double target = 0, reached = 0;                        ///< S required, and S of the best candidate
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< r of the best candidate
  std::vector<Blocker> blockers;                         ///< blocking pairs, largest f first; at most 4
  /// The most frequent reasons why edits were refused, with counts; at most 3.
  std::vector<std::string> constraints;
  std::vector<Remedy> remedies;  ///< changes that would help, largest S first
};

/// Options of `diagnose`.
struct DiagnosisOptions {
  /// Largest number of designs made to find reasons and remedies, >= 0.
  double designs = std::numeric_limits<double>::infinity();
  /// Directions that cost as much as one design, > 0. The search for another direction may try this many per
  /// design that is left.
  double directions_per_design = 8;
  std::function<bool()> cancelled = {};  ///< asked from the calling thread and from worker threads
};

/// Explains why a search did not reach its target, for the candidate of largest S. Finds the blocking pairs,
/// and changes that would help: another direction, freeing a part that had to stay, relaxing the height or
/// the box, leaving out a part (removal.h). Blocking pairs are always determined; reasons and remedies only
/// within the limits of the options. Precondition: `result.nearest` is not empty.
Diagnosis diagnose(const RequirementChecker& checker, const BestFirstResult& result,
                   const DiagnosisOptions& options = {});

/// Returns the diagnosis as text for people, a few lines.
std::string text(const Diagnosis& diagnosis, const StructuredShape& rest);

}  // namespace stackabilization
