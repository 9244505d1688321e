#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "editing/session/handle_range.h"
#include "editing/session/lanes.h"
#include "editing/session/node_designs.h"
#include "editing/session/workspace.h"

namespace stackabilization::editing {

/// What is known of the current design.
struct Advice {
  std::optional<Review> review;
  std::vector<OfferedEdit> suggestions;
  std::vector<ObstacleCount> refused;
  bool complete = false;  ///< whether all suggestions are known
  std::optional<Diagnosis> diagnosis;
  std::optional<HandleRange> range;
  std::optional<DirectionMap> map;
  std::optional<HeightField> envelopes;
};

/// A drag that was not ended yet.
struct DragState {
  MeasuredDesign design;  ///< what is shown instead of the current design
  Edit edit;              ///< that it has beyond the current design
};

/// State of a session. Commands are in design_commands.cpp, wish_commands.cpp and structure_commands.cpp,
/// jobs in advice_jobs.cpp and automatic_job.cpp, all else in session_implementation.cpp.
class EditingSession::Implementation {
 public:
  Implementation(Document document, SessionOptions options, Listener listener);
  ~Implementation() { lanes_.cancel_all(); }

  void execute(const Command& command) {
    std::visit([this](const auto& one) { run(one); }, command);
  }
  std::optional<Job> next_job(Lane lane);
  void open(Document document, SessionOptions options);

  Document document_;
  SessionOptions options_;
  Listener listener_;
  std::shared_ptr<const Workspace> workspace_;
  mutable NodeDesigns designs_;
  std::vector<Document> earlier_;  ///< documents before each change of the structure
  Direction direction_{0, 0, 1};
  Stackability at_rest_;
  MeasuredDesign current_;
  std::optional<DragState> drag_;
  Advice advice_;
  FoundDesigns found_;
  bool unsaved_ = false;  ///< whether the last change could not be written
  Lanes lanes_;

 private:
  void emit(const Event& event) const {
    if (listener_) listener_(event);
  }
  History& history() { return document_.project.history; }
  EditedFrom from_current() const {
    return {workspace_, current_.design, direction_, at_rest_.value, current_.assessment.measured.value};
  }
  const Structure& structure() const { return workspace_->space().rest().structure; }
  const std::vector<std::string>& part_names() const { return workspace_->space().rest().shape.part_names; }

  /// Measures the current node, and forgets what is known of the one before.
  void load_node();
  void forget_advice();
  /// Saves the document, and says that the current node changed.
  void announce_node();
  void save();
  /// Makes a node current, as a step that Undo reverts.
  void visit(int node);
  void go_to_place(std::size_t place);
  /// Adds a node with a design that was measured along its direction.
  void add_node(HistoryNode node, std::shared_ptr<const Design> design);
  HistoryNode node_with(std::vector<Edit> edits, std::string name) const;
  /// Adds a node with one more edit, from which `made` came.
  void keep_edit(const Edit& edit, const MeasuredDesign& made);
  /// Ends the automatic search; what it has found stays.
  void stop_finding();
  /// Replaces the requirements.
  void require(const Requirements& requirements);
  /// Starts anew with a document.
  void load(Document document);
  void load(Document document, std::shared_ptr<const Workspace> workspace);
  /// Goes on with another structure of the same shape and the same wishes.
  void replace_structure(StructuredShape structured);
  /// Analyses a shape with its parts as they are. `forced`: kinds of primitives, by part name.
  void analyse(const Shape& shape, const std::map<std::string, PrimitiveKind>& forced);

  void run(const ApplySuggestion& command);
  void run(const Drag& command);
  void run(const EndDrag& command);
  void run(const FindRange& command);
  void run(const RollBack& command);
  void run(const Undo& command);
  void run(const Redo& command);
  void run(const TakeDesign& command);
  void run(const SetTarget& command);
  void run(const SetLengthLimit& command);
  void run(const SetLimit& command);
  void run(const KeepParts& command);
  void run(const SetDirection& command);
  void run(const FindDesigns& command);
  void run(const StopFinding& command);
  void run(const AcceptRemedy& command);
  void run(const Segment& command);
  void run(const SetKind& command);
  void run(const RemoveRelations& command);
  void run(const RemoveParts& command);
  void run(const Join& command);
  void run(const MakeSymmetric& command);
  void run(const TakeEdit& command);
  void run(const MapDirections& command);
  void run(const SampleEnvelopes& command);

  JobWork review_work();
  JobWork suggestion_work();
  JobWork range_work();
  JobWork automatic_work();
  JobWork map_work();
  JobWork envelope_work();
  void deliver_suggestions(std::vector<OfferedEdit> offered, const Cancelled& cancelled,
                           const Deliver& deliver);
  void deliver_found(const FoundDesigns& designs, const Cancelled& cancelled, const Deliver& deliver);

  std::optional<Edit> wanted_range_;
  bool range_runs_ = false;  ///< whether the job of the lane of advice is a range
  std::optional<FindDesigns> finding_wanted_;
  bool map_wanted_ = false, envelopes_wanted_ = false;
};

/// What a search for designs begins with.
FoundDesigns designs_to_find(const RequirementChecker& checker, const Direction& direction,
                             const FindDesigns& command);

/// Throws UsageError naming `what` if there is no such row.
void expect_row(int row, std::size_t size, const std::string& what);

/// Throws UsageError for a document without a node at rest, and for options out of range.
void expect_usable(const Document& document, const SessionOptions& options);

/// Returns the name of a node: what changed most, or `otherwise` where nothing is seen.
std::string node_name(const Explanation& change, const std::string& otherwise);

}  // namespace stackabilization::editing
