#pragma once

#include <functional>
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
  std::string reason;  ///< why the edits that would separate it were refused, or did not help
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
  double target = 0, reached = 0;        ///< S asked for; largest S met
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< along which that is
  std::vector<Blocker> blockers;         ///< largest f first
  std::vector<std::string> constraints;  ///< requirements and relations that refused edits, most often first
  std::vector<Remedy> remedies;          ///< largest S first
};

/// What blocks the best candidate of a search that did not reach its target, and what would help: another
/// direction, freeing a part that had to stay, removing one (removal.h). Precondition: `result.nearest` is
/// not empty. What blocks is always found; what would help is looked for until `cancelled`, which is asked
/// from the calling thread and by the search for directions.
Diagnosis diagnosed(const RequirementChecker& checker, const BestFirstResult& result,
                    const std::function<bool()>& cancelled = {});

/// The diagnosis as text, a few lines for people.
std::string text(const Diagnosis& diagnosis, const StructuredShape& rest);

}  // namespace stackabilization
