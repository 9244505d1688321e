#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "stackabilization/improvement/improve.h"

namespace stackabilization {

/// Options of ImprovementTask.
struct ImprovementTaskOptions {
  DeformationKind kind = DeformationKind::controllers;  ///< deformation model
  Following following = Following::free;                ///< controllers: how parts follow an edit
  /// Starting directions, the preferred one first. If empty, the task chooses them.
  std::vector<Eigen::Vector3d> directions;
  /// Work for the choice of directions: a share of an effort (see effort.h), > 0.
  double effort = 1;
  std::function<void(double)> progress = {};  ///< as SearchOptions::progress, while directions are searched
  std::function<bool()> cancelled = {};       ///< as SearchOptions::cancelled, while directions are searched
};

/// A shape, the requirements of its design, and everything that a search for the design needs.
///
/// Starting directions, where none are given: up, which is the z axis, or an axis of symmetry within one
/// degree of it along which the shape stacks better; and the best direction of a search if it raises S by
/// more than 0.1. With a length limit or gap scaling only up. With limits of quality the search looks at
/// directions within 30 degrees of up, in which the object still stands; the diagnosis offers others.
///
/// With a length limit the target is S at which the copies fit the length with the height and the boxes at
/// rest (plan_stack).
class ImprovementTask {
 public:
  /// Throws as `deformation_model`, `validate` of the requirements and `best_direction`. Throws UsageError
  /// when the length limit leaves no room for the copies, however well they stack.
  ImprovementTask(StructuredShape rest, Requirements requirements,
                  const ImprovementTaskOptions& options = {});

  const StructuredShape& rest() const { return space_->rest(); }   ///< the shape given
  const DeformationModel& space() const { return *space_; }        ///< designs of the shape
  const RequirementChecker& checker() const { return *checker_; }  ///< checks designs of that space
  const std::vector<Eigen::Vector3d>& directions() const { return directions_; }  ///< starting directions
  /// Returns whether `cancelled` ended the search for directions; only up is a starting direction then.
  bool cancelled() const { return cancelled_; }

 private:
  std::vector<Eigen::Vector3d> directions_;
  bool cancelled_ = false;
  std::unique_ptr<const DeformationModel> space_;
  std::unique_ptr<const RequirementChecker> checker_;
};

/// Searches for designs that meet the requirements of the task, from its starting directions; those of
/// `options` are ignored. Otherwise as `improve` of improve.h.
Improvement improve(const ImprovementTask& task, ImprovementOptions options = {},
                    const std::optional<SavedSearch>& state = std::nullopt);

}  // namespace stackabilization
