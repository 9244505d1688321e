#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/improvement/best_first.h"
#include "stackabilization/improvement/closed.h"
#include "stackabilization/improvement/partition.h"

namespace stackabilization {

/// A pair of contact regions that prevents a larger S.
struct Blocker {
  int upper_part = -1, lower_part = -1;  ///< parts of the copies below and above, rows of Structure::parts
  ContactType type = ContactType::dot;   ///< type of the region
  /// Exact separation of the two parts alone along r, model units, without clearance and play. f_max of the
  /// design where the two parts alone pass each other.
  double f = 0;
  double stackability = 0;  ///< S if this pair were the only obstacle, Eq. 3 with `f`
  /// What the edits that would separate the pair give.
  enum class Edits {
    untried,     ///< no edit was tried
    unfinished,  ///< time was up before every edit was tried
    none,        ///< there are no such edits
    helpful,     ///< one of them raises S to `best_stackability`
    unhelpful,   ///< none of them raises S
    refused,     ///< all of them are refused, most for `obstacle`
  };
  Edits edits = Edits::untried;  ///< see Edits
  double best_stackability = 0;  ///< S after the best of the edits; at least that of the design
  Obstacle obstacle;             ///< most frequent obstacle, without amounts; refused only
};

/// Returns why a pair still blocks, one clause: what became of the edits that would separate it. Empty where
/// none was tried. `rest`: structure of the shape at rest.
std::string reason_of(const Blocker& blocker, const Structure& rest);

/// Returns what blocks, and why, as sentences: "'leg' of each copy comes down on 'top' of the copy below.
/// ..."
std::string describe(const Blocker& blocker, const Structure& rest);

/// A change that would raise S.
struct Remedy {
  /// Kinds of changes.
  enum class Kind {
    other_direction,  ///< stack along another direction
    free_part,        ///< let parts change
    remove_part,      ///< leave parts out
    take_apart,       ///< take parts off, and stack the pieces apart (partition.h)
    relax_height,     ///< let the height change
    relax_box,        ///< let the box change
    relax_quality,    ///< leave a measure of quality without a limit
  };
  Kind kind = Kind::relax_height;  ///< kind of the change
  /// Parts to be freed, left out or taken off; rows of Structure::parts.
  std::vector<int> parts;
  QualityMeasure measure = QualityMeasure::self_intersection;  ///< relax_quality: the measure
  /// r along which `stackability` is measured; the new direction for other_direction.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  /// S(M, r) with the change. other_direction and remove_part: of the shape at rest, without further edits;
  /// take_apart: of its pieces (Partition::stackability).
  /// free_part, relax_...: after the best single edit of the design that the change allows.
  double stackability = 0;
  std::vector<Piece> pieces = {};  ///< take_apart: all pieces, those that stay together included
};

/// Returns the change as an imperative clause: "let 'leg_1' and 'leg_2' change". `rest`: structure of the
/// shape at rest.
std::string describe(const Remedy& remedy, const Structure& rest);

/// Why a target was not reached.
struct Diagnosis {
  double target = 0, reached = 0;                        ///< S required, and S of the best candidate
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< r of the best candidate
  std::optional<ClosedPair> closed;                      ///< what closes the shape to copies of itself
  std::vector<Blocker> blockers;                         ///< blocking pairs, largest f first; at most 4
  std::vector<ObstacleCount> constraints;                ///< the most frequent obstacles; at most 3
  std::vector<Remedy> remedies;                          ///< changes that would help, largest S first
  /// The best design that one more edit of the best candidate makes, as asked, if it is better and passes
  /// every check but the target.
  std::optional<Candidate> better;
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
/// and changes that would help: another direction, freeing a part that had to stay, relaxing the height, the
/// box or a measure of quality, leaving out parts with at most half of the surface (removal.h), taking the
/// object apart (partition.h). Blocking pairs are always determined; reasons and remedies only within the
/// limits of the options. Precondition: `result.nearest` is not empty.
Diagnosis diagnose(const RequirementChecker& checker, const BestFirstResult& result,
                   const DiagnosisOptions& options = {});

/// Returns the diagnosis as text for people, a few lines. `rest`: structure of the shape at rest.
std::string text(const Diagnosis& diagnosis, const Structure& rest);

}  // namespace stackabilization
