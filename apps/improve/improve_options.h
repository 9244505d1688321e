#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/requirement_options.h"
#include "apps/common/structured_model.h"
#include "stackabilization/improvement/task.h"

namespace stackabilization::apps {

/// Options of `stackabilize improve` as typed; what is left out keeps its default.
struct ImproveCommandOptions {
  CommonOptions common;
  AnalysisArguments analysis;
  StackabilityOptions measure;
  std::optional<double> target;  ///< --target
  StackRoom room;                ///< instead
  std::optional<int> solutions;  ///< --solutions; default 3, and 8 for a front
  bool front = false;            ///< --front
  DeformationKind kind = DeformationKind::controllers;
  ImprovementPreset preset = ImprovementPreset::refined;
  ChangeMeasure objective = ChangeMeasure::both;
  std::vector<Eigen::Vector3d> directions;
  bool bends = false;
  std::optional<double> cone_degrees, alpha, effort, seconds;
  std::optional<std::int64_t> expansions;
  RequirementArguments requirements;
  std::vector<std::string> removed;  ///< names of parts
  bool twist = false, resume = false, no_pictures = false;
  std::string folder;

  /// Solutions to look for.
  int wanted() const { return solutions.value_or(front ? 8 : 3); }
  /// S to be reached, where that is asked for: of a front without --target, more than anything reaches.
  std::optional<double> wanted_target() const;
  /// Copies of the stacks that are shown.
  int shown_copies() const { return room.copies.value_or(5); }
};

void add_improve_options(CLI::App& command, ImproveCommandOptions& options);

/// Throws UsageError when options contradict each other or the folder holds what would be replaced,
/// OutputError when it cannot be written.
void check(const ImproveCommandOptions& options);

/// How the search for the task goes; without directions, deadline and callbacks.
ImprovementOptions improvement_options_of(const ImproveCommandOptions& options, const ImprovementTask& task);
/// How much work is done at most.
double effort_of(const ImproveCommandOptions& options);

}  // namespace stackabilization::apps
