#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "common/models.h"
#include "stackabilization/improvement/requirements.h"

namespace stackabilization::experiments {

/// An object, and how well it is to stack.
struct StudyTask {
  std::string name;  ///< as tables call it
  ModelFile model;
  std::vector<std::string> without;                      ///< names of parts that are left out
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< along which it is stacked
  Requirements requirements;                             ///< the target, and what S means
};

/// Shipped models for the seven kinds of objects in the authors' study, with targets of our own, along
/// directions at or near z, with the boxes of the file.
std::vector<StudyTask> shipped_tasks();

/// Of the seven tasks of the authors' study those whose models are in the folder, along z, with the boxes of
/// the file.
struct AuthorsTasks {
  std::vector<StudyTask> tasks;
  std::vector<std::string> absent;  ///< names of the others
};

/// Models are found by their names, wherever they lie below the folder of the study; of two with one name the
/// first by path counts. Throws InputError when the folder, or its tasks.txt, is missing or damaged.
AuthorsTasks authors_tasks(const std::filesystem::path& paper_data);

/// A plan of these tasks for `stackabilize edit PLAN --study FILE --boxes frame`, to be kept in `folder`,
/// from which the paths of the models lead.
std::string study_plan_text(const std::vector<StudyTask>& tasks, const std::filesystem::path& folder);

/// The shape of a task with its structure found.
StructuredShape structured_shape(const StudyTask& task);

}  // namespace stackabilization::experiments
