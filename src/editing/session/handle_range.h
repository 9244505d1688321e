#pragma once

#include <functional>
#include <memory>

#include "editing/session/workspace.h"

namespace stackabilization::editing {

/// A design from which edits are tried.
struct EditedFrom {
  std::shared_ptr<const Workspace> workspace;
  std::shared_ptr<const Design> design;
  Direction direction;
  double at_rest = 0;                      ///< S of the shape at rest along `direction`
  double now = 0;                          ///< S of the design along `direction`
  QualityScope scope = QualityScope::all;  ///< measures of quality that an edit has to keep
};

/// A design with an edit, or what stands against it.
struct TriedEdit {
  std::shared_ptr<const Design> made;  ///< not null if the edit can be made within all limits of `scope`
  std::optional<Obstacle> obstacle;    ///< otherwise
};

/// Measures a design with the scope of `from`.
MeasuredDesign measured(const EditedFrom& from, std::shared_ptr<const Design> design);

/// Tries an edit. S is not measured.
TriedEdit try_edit(const EditedFrom& from, const Edit& edit);

/// The largest part of an edit that can be made.
struct LargestEdit {
  MeasuredDesign made;
  double amount = 0;                 ///< share of the edit, in [0, 1]
  std::optional<Obstacle> obstacle;  ///< what stands against more of it; none if `amount` is 1
};

/// Returns the largest part of `edit` that can be made, found by bisection between an amount that can and one
/// that cannot. `known`: an amount below which everything can be made, tried first.
LargestEdit largest_part(const EditedFrom& from, const Edit& edit, double known);

/// Returns the range of a handle, see EditingSession::range. `cancelled` is asked between designs; the range
/// then is incomplete.
HandleRange handle_range(const EditedFrom& from, const Edit& edit, const std::function<bool()>& cancelled);

}  // namespace stackabilization::editing
