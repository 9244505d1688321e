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
  /// Controllers: how parts follow an edit. If empty, smoothly with limits of quality, and freely without.
  std::optional<Following> following;
  /// Starting directions, the preferred one first, which designs keep. If empty, the task chooses them.
  std::vector<Eigen::Vector3d> directions;
  /// Directions that the task chose in an earlier run, which it then does not look for again; see
  /// directions_of. Ignored where directions are given.
  std::vector<Eigen::Vector3d> chosen;
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
  /// Returns whether designs may stack along other directions than these: not where directions were given,
  /// with a length limit, or with a model that edits along one direction.
  bool directions_are_free() const { return free_; }
  /// Returns whether `cancelled` ended the search for directions; only up is a starting direction then.
  bool cancelled() const { return cancelled_; }

 private:
  std::vector<Eigen::Vector3d> directions_;
  bool free_, cancelled_ = false;
  std::unique_ptr<const DeformationModel> space_;
  std::unique_ptr<const RequirementChecker> checker_;
};

/// Returns the options that suit a task: those of its deformation model (improve.h) and, where directions are
/// free, a cone of 10 degrees in which they may turn at each edit.
ImprovementOptions improvement_options(const ImprovementTask& task);

/// Searches for designs that meet the requirements of the task, with the options that suit it.
Improvement improve(const ImprovementTask& task);

/// Searches for designs that meet the requirements of the task, from its starting directions; those of
/// `options` are ignored. Otherwise as `improve` of improve.h.
Improvement improve(const ImprovementTask& task, ImprovementOptions options,
                    const std::optional<SavedSearch>& state = std::nullopt);

}  // namespace stackabilization
