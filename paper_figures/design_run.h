#pragma once

#include <memory>
#include <string>
#include <vector>

#include "paper_figures/input.h"
#include "stackabilization/deformation/factory.h"
#include "stackabilization/improvement/task.h"
#include "stackabilization/rendering/pictures.h"
#include "stackabilization/structure/analysis.h"

/// Designs that are made stackable for a figure.
namespace stackabilization::figures {

/// A model, how it is analysed, and what is asked of it. Everything happens along one direction, and nothing
/// is ended by a clock, so that the result is the same on every machine.
struct DesignTask {
  ModelSource model;
  std::vector<std::string> removed;    ///< names of parts that are left out first
  std::vector<std::string> kept;       ///< names of parts that stay as they are
  std::vector<std::string> cuboids;    ///< names of parts that become cuboids; others: the better fit
  std::vector<std::string> cylinders;  ///< names of parts that become generalized cylinders
  SegmentationMethod segmentation = SegmentationMethod::automatic;
  DeformationModelOptions space;
  Requirements requirements;
  ImprovementOptions options;
};

/// {"model": {...}, "direction": [0, 0, 1], "target": 0.5, "expansions": 2} and, where they are not the
/// defaults, "boxes" (oriented or frame), "deformation" (controllers, surface or iwires), "preset" (refined
/// or paper), "segmentation" (whole or components), and lists of parts "remove", "keep", "cuboids" and
/// "cylinders".
DesignTask read_design_task(const Fields& fields);

/// What became of a task.
struct DesignRun {
  std::unique_ptr<const ImprovementTask> task;
  Improvement result;

  const StructuredShape& rest() const { return task->rest(); }
  bool reached() const { return !result.solutions.empty(); }
  /// The best solution, or what came nearest to one.
  const Candidate& best() const;
};

/// The structured shape of a task, parts left out. Throws InputError for a part that does not exist.
StructuredShape structured_shape(const DesignTask& task, const ModelFolder& models);

/// Searches. Throws InputError as the model demands.
DesignRun design_run(const DesignTask& task, const ModelFolder& models);

/// The same for several, side by side; each result is what it would be alone. Throws as design_run.
std::vector<DesignRun> design_runs(const std::vector<DesignTask>& tasks, const ModelFolder& models);

/// The tasks of objects that have one each.
template <class Object>
std::vector<DesignTask> tasks_of(const std::vector<Object>& objects) {
  std::vector<DesignTask> tasks;
  for (const Object& object : objects) tasks.push_back(object.task);
  return tasks;
}

/// The same as design_run for a shape that was made otherwise, such as a piece of another.
DesignRun design_run(StructuredShape rest, const DesignTask& task);

/// The shape at rest and the best design, measured along the direction of the task.
ImprovedShape improved_shape(const DesignRun& run);

}  // namespace stackabilization::figures
