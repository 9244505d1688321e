#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/core/errors.h"
#include "stackabilization/improvement/contact_edits.h"
#include "stackabilization/improvement/energy.h"
#include "stackabilization/improvement/requirements.h"

namespace stackabilization {

/// Progress of a search.
struct ImprovementProgress {
  double best_stackability = 0;  ///< largest S(M, r) of all candidates measured
  double best_energy = 0;        ///< least E of all candidates measured
  std::int64_t expanded = 0;     ///< expanded candidates: their successors were made
  std::int64_t evaluated = 0;    ///< designs measured
  std::int64_t trials = 0;       ///< edits tried, counted as for BestFirstOptions::trials
  std::int64_t queued = 0;       ///< candidates in the queues of all starting directions
  int solutions = 0;             ///< solutions found
  double work = 0;               ///< share of the allowed work that is done, in [0, 1]; 0 without limits
  double seconds_left = 0;       ///< seconds until the deadline; infinite without one
};

/// Options of `best_first`.
struct BestFirstOptions {
  double alpha = 0.2;             ///< weight of D in Eq. 5, in [0, 1]
  ContactEditOptions edits;       ///< edits that contacts suggest
  int solutions = 1;              ///< number of different solutions wanted, >= 1
  std::int64_t expansions = 100;  ///< largest number of expanded candidates, >= 0
  /// Largest number of edits tried, >= 0. An edit counts whether or not it succeeds; with a cone every
  /// expansion counts 8 more. The search ends at a candidate whose edits would exceed the rest of this
  /// number.
  std::int64_t trials = std::numeric_limits<std::int64_t>::max();
  /// Deadline of one call, seconds, > 0. With a finite deadline the result depends on the machine.
  double seconds = std::numeric_limits<double>::infinity();
  /// Half-angle of the cone around a candidate's direction in which its direction is searched again, degrees,
  /// in [0, 90]. With 0 every candidate keeps its starting direction.
  double cone_degrees = 0;
  /// Starting directions, the preferred one first; not empty.
  std::vector<Eigen::Vector3d> directions = {{0, 0, 1}};
  std::function<void(const ImprovementProgress&)> progress = {};  ///< called from the calling thread
  std::function<bool()> cancelled = {};  ///< asked from the calling thread; true ends the search
  /// Called before the first step, now and then, and at the end, from the calling thread.
  /// `resume_best_first` accepts the text.
  std::function<void(const std::string& state)> save = {};
};

/// A design of a search with its measures.
struct Candidate {
  Design design;                                         ///< edits from rest, primitives and mesh
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< r, stacking direction
  Stackability measured;            ///< S(M, r) with its terms, f_max with the clearance and play required
  Energy energy;                    ///< E of Eq. 5 against the shape at rest
  std::vector<EditReason> reasons;  ///< one reason per edit
};

/// Why a search ended: enough solutions were found, no candidate was left, a limit was reached (expansions,
/// trials or time), or the caller cancelled it.
enum class SearchEnd { solved, exhausted, expansion_limit, trial_limit, time_limit, cancelled };

/// Result of `best_first`.
struct BestFirstResult {
  /// Solutions: they reach the target, pass every check and differ from each other (see `best_first`); least
  /// E first.
  std::vector<Candidate> solutions;
  /// Candidates of largest S that are no solutions, S descending, at most 8. No two of them make the same
  /// kinds of edits to the same handles. With limits of quality one more where none of them keeps all
  /// requirements but the target: the best that does, if it is among the 40 of largest S; the 8 after a
  /// deadline. None is looked for when the search is cancelled.
  std::vector<Candidate> nearest;
  std::vector<ObstacleCount> refusals;   ///< why edits were refused and checks failed, see `sort_by_count`
  ImprovementProgress progress;          ///< counts at the end
  SearchEnd end = SearchEnd::exhausted;  ///< why the search ended
};

/// A text that was passed to BestFirstOptions::save.
struct SavedSearch {
  std::string text;                   ///< the text, unchanged
  std::string name = "saved search";  ///< name for error messages, such as a path
};

/// Thrown when a saved search cannot be resumed: the text is damaged or belongs to another task. The message
/// names the search, the place in the text and what was expected there.
class SavedSearchError : public InputError {
 public:
  using InputError::InputError;
};

/// Best-first search, Algorithm 1 of the paper. Each step takes the queued candidate of least E (ties: the
/// one made first). A candidate that reaches the target and passes every check is a solution and is not
/// expanded. One that reaches the target, but does not differ from an earlier solution, is dropped. Every
/// other candidate is expanded: its contacts suggest the edits that make its successors (contact_edits.h).
///
/// Visited set: no configuration is looked at twice. Configurations are compared on a grid of 1e-6 of the
/// diagonal, up to a translation of the whole shape.
///
/// Directions: every starting direction has a queue and a visited set of its own, and the queues take turns.
/// Before a candidate that misses the target is expanded, its direction is searched again in the cone of the
/// options. The search stays within the symmetry plane that contains the direction; where two such planes or
/// an axis of symmetry contain it, the direction is kept. Where the height has to be kept, only directions
/// are allowed along which the design has the height of the shape at rest. Gains are against S of the shape
/// at rest along the first starting direction, so energies are comparable across directions.
///
/// Solutions: two designs are different when the change between them (shape_change.h) is at least half of the
/// smaller of their changes from rest. A tenth is enough when their edits use different handles (symmetric
/// parts count as one) or move the handles differently.
///
/// The result is the same for any number of threads and after any interruption, unless the deadline ends the
/// search. Throws UsageError for options out of range, and for a cone with gap scaling, which keeps its
/// direction.
BestFirstResult best_first(const RequirementChecker& checker, const BestFirstOptions& options);

/// Resumes a search from a text that `save` received. Checker and options must be those of the saved search,
/// except for the limits. The expansions and trials of the saved search count against the limits. Its seconds
/// do not: the text holds no times, so equal searches save equal bytes. Throws SavedSearchError, and as
/// `best_first`.
BestFirstResult resume_best_first(const RequirementChecker& checker, const BestFirstOptions& options,
                                  const SavedSearch& state);

/// Returns the text that a search saves before its first step. Throws as `best_first`.
std::string search_at_start(const RequirementChecker& checker, const BestFirstOptions& options);

/// Returns the starting directions of a saved search, to the bit. Throws SavedSearchError.
std::vector<Eigen::Vector3d> directions_of(const SavedSearch& state);

/// Returns whether `text` is a saved search, of any task and any version.
bool is_search_state(const std::string& text);

}  // namespace stackabilization
