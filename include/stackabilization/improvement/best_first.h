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

/// Where a search stands.
struct ImprovementProgress {
  double best_stackability = 0;  ///< of all candidates seen
  double best_energy = 0;        ///< least E of all candidates seen
  std::int64_t expanded = 0;     ///< candidates whose successors were made
  std::int64_t evaluated = 0;    ///< designs measured
  std::int64_t queued = 0;       ///< candidates that wait, over all starting directions
  int solutions = 0;             ///< found so far
  double seconds_left = 0;       ///< until the deadline; infinite without one
};

/// Options of `best_first`.
struct BestFirstOptions {
  double alpha = 0.2;             ///< of Eq. 5
  ContactEditOptions edits;       ///< what contacts suggest
  int solutions = 1;              ///< different ones wanted, >= 1
  std::int64_t expansions = 100;  ///< limit, >= 0
  /// Limit, >= 0: edits tried in all, whatever comes of them. A candidate whose edits would be more than are
  /// left ends the search.
  std::int64_t trials = std::numeric_limits<std::int64_t>::max();
  /// Deadline of one call, > 0. Only a finite one makes what is found depend on the machine.
  double seconds = std::numeric_limits<double>::infinity();
  /// The direction is searched again within this angle of the previous one. 0: candidates keep the direction
  /// that they start from.
  double cone_degrees = 0;
  /// Directions to start from, the first preferred; not empty.
  std::vector<Eigen::Vector3d> directions = {{0, 0, 1}};
  std::function<void(const ImprovementProgress&)> progress = {};  ///< called from the calling thread
  std::function<bool()> cancelled = {};                           ///< asked from the calling thread
  /// Called now and then, and at the end, with a text that best_first_resumed takes.
  std::function<void(const std::string& state)> save = {};
};

/// A candidate: what it is, how good, and why it was made.
struct Candidate {
  Design design;                                         ///< edits from rest, primitives and mesh
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< r along which it is stacked
  Stackability measured;                                 ///< along r, with the air asked for
  Energy energy;                                         ///< against rest
  std::vector<std::string> reasons;                      ///< per edit, see ContactEdit::why
};

/// How often successors were refused, or designs that reach the target failed a check, and why: what a
/// diagnosis looks at.
struct RefusalCount {
  std::string reason;      ///< with "..." for amounts
  std::int64_t count = 0;  ///< how often
};

/// Why a search ended: enough solutions, nothing left to expand, a limit (of expansions, of trials, of time),
/// or the caller.
enum class SearchEnd { solved, exhausted, expansion_limit, trial_limit, time_limit, cancelled };

/// What `best_first` found.
struct BestFirstResult {
  std::vector<Candidate> solutions;  ///< reach the target and pass every check; different; least E first
  /// The most promising candidates that do not reach it, S descending, different from each other; at most 8.
  std::vector<Candidate> nearest;
  std::vector<RefusalCount> refusals;    ///< most frequent first
  ImprovementProgress progress;          ///< counts at the end
  std::int64_t trials = 0;               ///< edits tried, see BestFirstOptions::trials
  SearchEnd end = SearchEnd::exhausted;  ///< why it ended
};

/// A text given to BestFirstOptions::save.
struct SavedSearch {
  std::string text;                   ///< as it was given
  std::string name = "saved search";  ///< what messages call it, such as a path
};

/// A saved search cannot be gone on with: it is damaged, or belongs to another task. The message names the
/// search, the place and what was expected.
class SavedSearchError : public InputError {
 public:
  using InputError::InputError;
};

/// Algorithm 1 of the paper: of all candidates that of least E (ties: made first) is taken; one that reaches
/// the target and passes every check is a solution, and is not edited further; of the others the contacts
/// suggest successors (contact_edits.h). With a visited set, so that no configuration is looked at twice (to
/// a grid of 1e-6 of the diagonal, wherever the whole is), and limits. Starting directions take turns, each
/// with a queue of its own. The direction is searched again when a candidate is taken, inside a cone and
/// within the symmetry planes that contain it, where the height stays what it was. Gains are over S of the
/// shape at rest along the first starting direction, so that energies compare across directions.
///
/// Two solutions are different when the change between them (shape_change.h) is at least half of the smaller
/// of their changes from rest; a tenth is enough when their edits take hold of different handles (symmetric
/// parts counted as one) or move them otherwise.
///
/// The same result for any number of threads, and after any interruption, unless the deadline ends it.
/// Throws UsageError for options out of range, and for gap scaling with a cone: it keeps its direction.
BestFirstResult best_first(const RequirementChecker& checker, const BestFirstOptions& options);

/// Goes on from a text given to `save` by a search with the same checker and options; only its limits may be
/// others. The expansions and trials that it made count, the seconds it used do not: they are of no state, so
/// that the same search saves the same bytes. Throws SavedSearchError.
BestFirstResult best_first_resumed(const RequirementChecker& checker, const BestFirstOptions& options,
                                   const SavedSearch& state);

/// What a search saves before its first step.
std::string search_at_start(const RequirementChecker& checker, const BestFirstOptions& options);

/// The starting directions of a saved search, to the bit. Throws SavedSearchError.
std::vector<Eigen::Vector3d> directions_of(const SavedSearch& state);

/// Is it a text given to `save`, of whatever search and version?
bool is_search_state(const std::string& text);

}  // namespace stackabilization
