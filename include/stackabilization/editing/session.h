#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "stackabilization/editing/command.h"
#include "stackabilization/editing/document.h"
#include "stackabilization/editing/event.h"
#include "stackabilization/envelope/height_field.h"
#include "stackabilization/improvement/explanation.h"
#include "stackabilization/improvement/improve.h"
#include "stackabilization/improvement/shape_change.h"
#include "stackabilization/improvement/suggestions.h"
#include "stackabilization/stacking/map.h"

namespace stackabilization::editing {

/// A design with the measures that follow each step of a drag.
struct MeasuredDesign {
  std::shared_ptr<const Design> design;  ///< never null in a session
  /// S(M, r), and the checks of all requirements, of quality at least those of QualityScope::parts.
  Assessment assessment;
  Energy energy;       ///< E against the shape at rest along the same direction
  ShapeChange change;  ///< from the shape at rest
};

/// What takes longer to find out about the current design, and follows in the background.
struct Review {
  Assessment assessment;                ///< all checks of all requirements
  std::vector<ContactRegion> contacts;  ///< of the design stacked on itself
  Explanation explanation;              ///< change from the shape at rest, in words
};

/// A suggestion that can be made, with what a gallery shows of it.
struct OfferedEdit {
  Suggestion suggestion;                 ///< edit and effect
  std::shared_ptr<const Design> design;  ///< the current design with the edit
  Explanation explanation;               ///< change from the current design, in words
  double gain = 0;                       ///< S of `design` minus S of the current design
  ShapeChange change;                    ///< of `design` from the shape at rest
};

/// Part of an axis of a handle, and what stands at its ends.
struct HandleRange {
  /// A design on the axis.
  struct Sample {
    double amount = 0;        ///< share of the largest edit, in [-1, 1]
    double stackability = 0;  ///< S(M, r)
  };
  Edit edit;                      ///< the edit of amount 1
  std::vector<Sample> samples;    ///< amounts ascending, all within the range
  double low = 0, high = 0;       ///< ends of the range, in [-1, 0] and [0, 1]
  std::optional<Obstacle> below;  ///< what stands below `low`; none if it is -1
  std::optional<Obstacle> above;  ///< what stands above `high`; none if it is 1
};

/// S of a design along all directions.
struct DirectionMap {
  StackabilityMap map;                                        ///< even samples of the hemisphere z >= 0
  Eigen::Vector3d best_direction = Eigen::Vector3d::UnitZ();  ///< of largest S, as `best_direction` finds it
  double best = 0;                                            ///< S along it
};

/// A design that the automatic search has found.
struct FoundDesign {
  int number = 0;           ///< no other design of the search has it
  Candidate candidate;      ///< meets all requirements; the design of a front all but the target
  Explanation explanation;  ///< its change from the shape at rest, in words
  ShapeChange change;       ///< from the shape at rest
};

/// What the automatic search has found.
struct FoundDesigns {
  double target = 0;                       ///< S that was asked for
  std::optional<StackLengthLimit> within;  ///< or the length for some copies
  bool front = false;                      ///< or designs of all S, each with more than those before it
  double at_rest = 0;                      ///< S of the shape at rest along the direction of the search
  std::vector<FoundDesign> designs;        ///< least change first
  std::optional<Diagnosis> diagnosis;      ///< why there are none
  bool running = false;                    ///< whether the search goes on
};

/// Options of an EditingSession.
struct SessionOptions {
  double alpha = 0.2;              ///< weight of D in Eq. 5
  bool suggests = true;            ///< whether suggestions are looked for
  int max_suggestions = 12;        ///< suggestions that are offered, >= 1
  std::filesystem::path autosave;  ///< file written after each change; empty: none
  double effort = 1;               ///< effort of the automatic search, see improve.h
};

/// Threads on which jobs may run at the same time, one job each.
enum class Lane {
  advice,     ///< the review and the suggestions of the current design, the range of a handle: seconds
  automatic,  ///< the automatic search: minutes; a map of directions, before it
};

/// An editing session without its pixels (paper, section 5): one document, the design that is shown, and what
/// is known of it. Commands change it; a listener receives what changed. Designs keep the limits of quality
/// of the document, so that edits by hand have the same freedom as the automatic search.
///
/// Not safe from several threads. Long work is handed out as jobs, which may run on other threads; their
/// results are handed in on the thread of the session. Results that came too late, because a command changed
/// what they depend on, are dropped. The document after a list of commands does not depend on when jobs run,
/// except for those that take numbers of suggestions and designs found so far.
class EditingSession {
 public:
  /// Result of a job, to be called on the thread of the session.
  using Result = std::function<void()>;
  /// Long work. It passes results, from the thread that runs it, to `deliver`. The session must outlive the
  /// results, not the job.
  using Job = std::function<void(const std::function<void(Result)>& deliver)>;

  /// Throws as `new_document`, UsageError for options out of range, and InputError when a node of the history
  /// cannot be made again.
  EditingSession(Document document, SessionOptions options, Listener listener);
  ~EditingSession();
  EditingSession(const EditingSession&) = delete;
  EditingSession& operator=(const EditingSession&) = delete;

  /// Executes a command. Throws UsageError, and leaves the session as it is, for numbers that do not exist, a
  /// handle that the shape does not have, and values out of range.
  void execute(const Command& command);

  /// Goes on with another document and other options; nothing of the last one can be undone. Throws as the
  /// constructor, and leaves the session as it is.
  void open(Document document, SessionOptions options);

  /// Returns the next job of a lane, if there is one to do and none is running there. The caller has to run
  /// it.
  std::optional<Job> next_job(Lane lane);
  /// Lets running jobs end soon. Their results are dropped.
  void cancel();

  const Document& document() const;       ///< everything that is saved
  bool saved() const;                     ///< whether every change is in the file `autosave`
  const DeformationModel& space() const;  ///< designs of the shape
  const Direction& direction() const;     ///< r of the current node
  const Stackability& at_rest() const;    ///< S of the shape at rest along `direction`
  const MeasuredDesign& current() const;  ///< design of the current node
  const MeasuredDesign& shown() const;    ///< the dragged design while dragging, else the current one
  std::optional<Edit> drag() const;       ///< edit that `shown` has beyond the current node, while dragging
  bool dragging() const;                  ///< whether a drag was not ended yet
  bool can_undo() const;                  ///< whether Undo has an effect
  bool can_redo() const;                  ///< whether Redo has an effect
  const std::optional<Review>& review() const;          ///< of the current design, once it is known
  const std::vector<OfferedEdit>& suggestions() const;  ///< best first; grows in the background
  bool suggestions_complete() const;                    ///< whether all suggestions are known
  const std::vector<ObstacleCount>& refused() const;    ///< why other suggestions cannot be made
  /// Returns what blocks the current design and what would help, once all suggestions are known and none of
  /// them raises S.
  const std::optional<Diagnosis>& diagnosis() const;
  const std::optional<HandleRange>& range() const;  ///< of the last FindRange
  const FoundDesigns& found() const;                ///< by the automatic search
  const std::optional<DirectionMap>& map() const;   ///< of the last MapDirections for the current design
  /// Returns the envelopes along `direction`, of the last SampleEnvelopes for the current design.
  const std::optional<HeightField>& envelopes() const;
  /// Returns the design of a node. Throws UsageError when there is no such node.
  std::shared_ptr<const Design> design_of(int node) const;
  /// Returns f_max of a node along its direction, model units. Throws UsageError when there is no such node.
  double f_max_of(int node) const;
  /// Returns the limits and requirements of the designs.
  const RequirementChecker& checker() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace stackabilization::editing
