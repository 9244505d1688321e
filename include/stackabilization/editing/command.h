#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "stackabilization/deformation/edit.h"
#include "stackabilization/improvement/quality.h"
#include "stackabilization/improvement/requirements.h"
#include "stackabilization/structure/fitting.h"
#include "stackabilization/structure/segmentation.h"

/// Commands of an editing session. What a number refers to is what the session shows when it executes the
/// command.
namespace stackabilization::editing {

/// Makes the edit of a suggestion: a new node of the history.
struct ApplySuggestion {
  int number = 0;  ///< row of EditingSession::suggestions
};

/// Shows the current design with one more edit, without a new node. Where a limit does not allow the edit,
/// the session shows the largest part of it that all limits allow, and emits the obstacle; of limits of
/// quality those of QualityScope::parts are looked at. Each drag starts from the current design, not from the
/// last drag.
struct Drag {
  Edit edit;  ///< from the current design
};

/// Ends a drag. The largest part of it that all limits allow becomes a new node; where that is not all of it,
/// the session emits the obstacle.
struct EndDrag {
  bool keep = true;  ///< false: no node is made, and the drag is forgotten
};

/// Looks for the part of an axis of a handle on which all limits hold: EditingSession::range.
struct FindRange {
  Edit edit;  ///< largest edit one way; the other way ends at its inverse
};

/// Makes a node of the history current.
struct RollBack {
  int node = 0;  ///< row of History::nodes
};

/// Makes the node that was current before the last change current again.
struct Undo {};
/// Reverts the last Undo.
struct Redo {};

/// Changes the stackability that is wanted. No length limits the stack any more.
struct SetTarget {
  double target = 0;  ///< S, finite, < 1
};

/// Wants a stack of some copies within a length, in place of a stackability. Throws UsageError where the
/// length has no room for so many, however well they stack.
struct SetLengthLimit {
  StackLengthLimit limit;  ///< copies and length along the direction
};

/// Stacks along another direction: a new node without edits.
struct SetDirection {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< r, of any length that a Direction accepts
};

/// Changes the limit of a measure of quality.
struct SetLimit {
  QualityMeasure measure = QualityMeasure::size;  ///< the measure
  std::optional<double> limit;                    ///< new limit; empty: no limit
};

/// Changes the parts that must not change.
struct KeepParts {
  std::vector<int> parts;  ///< all of them, rows of Shape::part_names
};

/// Starts the automatic search for designs that reach the target, or for designs of all S.
struct FindDesigns {
  /// Whether a front is wanted: designs of least change from S at rest to the largest S that the limits
  /// allow, see front.h. Target and length limit are left out of account then.
  bool front = false;
};
/// Ends that search; what it has found stays.
struct StopFinding {};
/// Makes a found design current: a new node, child of the root. Throws UsageError where a better one has
/// taken its place.
struct TakeDesign {
  int number = 0;  ///< FoundDesign::number
};

/// Accepts a change that a diagnosis offers. Of an object that is taken apart, the session goes on with the
/// piece of most parts.
struct AcceptRemedy {
  /// Whose diagnosis.
  enum class Source {
    search,  ///< EditingSession::found
    advice,  ///< EditingSession::diagnosis
  };
  int number = 0;                  ///< row of Diagnosis::remedies
  Source source = Source::search;  ///< whose diagnosis
};

/// Segments the parts in which there are strokes anew, each triangle to the nearest stroke. Strokes of a new
/// name make a new part. The structure is analysed again, and the history begins anew; Undo brings the old
/// one back.
struct Segment {
  std::vector<PartSeeds> strokes;  ///< names of parts, and triangles of the shape; not empty
};

/// Gives a part another kind of primitive, with the same consequences.
struct SetKind {
  int part = 0;                                ///< row of Structure::parts
  PrimitiveKind kind = PrimitiveKind::cuboid;  ///< wanted kind
};

/// Takes relations out of the structure, such as a joint that is none. The history begins anew; Undo brings
/// the old one back.
struct RemoveRelations {
  std::vector<int> relations;  ///< rows of Structure::relations; not empty
};

/// Leaves parts out of the shape. The history begins anew; Undo brings the old one back.
struct RemoveParts {
  std::vector<int> parts;  ///< rows of Structure::parts; not empty, and not all
};

/// Joins two parts where they come nearest to each other, within a quarter of the smallest ball around
/// both. The history begins anew; Undo brings the old one back.
struct Join {
  std::array<int, 2> parts = {0, 1};  ///< rows of Structure::parts
};

/// Makes two parts that are mirror images of each other symmetric, in a plane of symmetry of the whole shape
/// where there is one for them, else in their own. The history begins anew; Undo brings the old one back.
struct MakeSymmetric {
  std::array<int, 2> parts = {0, 1};  ///< rows of Structure::parts
};

/// Makes one edit of a node again, from the current design: a new node. Throws UsageError, with the cause,
/// where a limit does not allow it.
struct TakeEdit {
  int node = 0;  ///< row of History::nodes
  int edit = 0;  ///< row of its edits
};

/// Measures the current design along all directions: EditingSession::map.
struct MapDirections {};

/// Samples the gap between the envelopes of the current design: EditingSession::envelopes.
struct SampleEnvelopes {};

/// A command.
using Command = std::variant<ApplySuggestion, Drag, EndDrag, FindRange, RollBack, Undo, Redo, SetTarget,
                             SetLengthLimit, SetDirection, SetLimit, KeepParts, FindDesigns, StopFinding,
                             TakeDesign, AcceptRemedy, Segment, SetKind, RemoveRelations, RemoveParts, Join,
                             MakeSymmetric, TakeEdit, MapDirections, SampleEnvelopes>;

}  // namespace stackabilization::editing
