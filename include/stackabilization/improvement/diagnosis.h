#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/improvement/best_first.h"

namespace stackabilization {

/// A pair of contact regions that is in the way.
struct Blocker {
  int upper_part = -1, lower_part = -1;  ///< of the copy below, and of the copy above
  ContactType type = ContactType::dot;   ///< of the region
  double f = 0;                          ///< what this pair alone asks for, model units
  double stackability = 0;               ///< S if it were the only one
  std::string reason;  ///< why the edits that would separate it were refused, or did not help; may be empty
};

/// Something that would help, with the S that it gives without further edits or, for a constraint, allows.
struct Remedy {
  /// What is to be done.
  enum class Kind { other_direction, free_part, remove_part, relax };
  Kind kind = Kind::relax;                              ///< says which of the fields below count
  std::string what;                                     ///< one sentence
  std::vector<int> parts;                               ///< to be freed or removed; rows of Structure::parts
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< to stack along instead; zero for other kinds
  double stackability = 0;                              ///< S(M, r) that it gives or allows
};

/// Why a target was not reached.
struct Diagnosis {
  double target = 0, reached = 0;                        ///< S asked for; largest S met
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< along which that is
  std::vector<Blocker> blockers;                         ///< largest f first
  std::vector<std::string> constraints;  ///< requirements and relations that refused edits, most often first
  std::vector<Remedy> remedies;          ///< largest S first
};

/// Options of `diagnosed`.
struct DiagnosisOptions {
  double designs =
      std::numeric_limits<double>::infinity();  ///< made at most to find reasons and remedies, >= 0
  double directions_per_design = 8;      ///< what a direction costs, for the look for other directions, > 0
  std::function<bool()> cancelled = {};  ///< asked from the calling thread
};

/// What blocks the best candidate of a search that did not reach its target, and what would help: another
/// direction, freeing a part that had to stay, removing one (removal.h). Precondition: `result.nearest` is
/// not empty. What blocks is always found; why, and what would help, is looked for within the limits.
Diagnosis diagnosed(const RequirementChecker& checker, const BestFirstResult& result,
                    const DiagnosisOptions& options = {});

/// The diagnosis as text, a few lines for people.
std::string text(const Diagnosis& diagnosis, const StructuredShape& rest);

}  // namespace stackabilization
