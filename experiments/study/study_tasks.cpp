#include "study/study_tasks.h"

#include <algorithm>

#include "common/authors_targets.h"
#include "common/json.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/part_names.h"
#include "stackabilization/improvement/removal.h"
#include "stackabilization/io/read.h"
#include "stackabilization/structure/analysis.h"

namespace stackabilization::experiments {

namespace {

struct Choice {
  std::string name, model;
  double target = 0;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  std::vector<std::string> without = {};
};

/// In the order of the authors' tasks.txt.
const std::vector<Choice>& choices() {
  static const std::vector<Choice> all = {
      {"cup", "cup", 0.83},
      {"cup-handle", "mug_with_handle", 0.55},
      {"table-skirt", "table", 0.5, {0, 0, 1}, {"middle_bar", "side_bar_left", "side_bar_right"}},
      {"chair", "chair", 0.5, {0, -0.1, 1}},
      {"stool", "stool", 0.5},
      {"table-middlebar", "table", 0.4},
      {"chair-armrest", "armchair", 0.42, {-0.12, 0, 1}},
  };
  return all;
}

}  // namespace

std::vector<StudyTask> shipped_tasks() {
  const std::vector<ModelFile> models = shipped_models();
  std::vector<StudyTask> tasks;
  for (const Choice& choice : choices()) {
    const auto model = std::find_if(models.begin(), models.end(),
                                    [&](const ModelFile& file) { return file.name == choice.model; });
    if (model == models.end()) throw InputError(choice.model + ".obj: not among the shipped models");
    StudyTask task{choice.name, *model, choice.without, choice.direction, {}};
    task.requirements.target = choice.target;
    task.requirements.measure.boxes = BoxModel::frame;
    tasks.push_back(std::move(task));
  }
  return tasks;
}

AuthorsTasks authors_tasks(const std::filesystem::path& paper_data) {
  const std::vector<ModelFile> models = paper_models(paper_data);
  AuthorsTasks result;
  for (const auto& [plain, asked] : authors_targets(paper_data)) {
    const auto model = std::find_if(models.begin(), models.end(), [&name = plain](const ModelFile& file) {
      return file.name.find("UserStudyApp/") != std::string::npos &&
             plain_task_name(file.path.stem().string()) == name;
    });
    if (model == models.end()) {
      result.absent.push_back(asked.task);
      continue;
    }
    StudyTask task{"authors/" + asked.task, *model, {}, Eigen::Vector3d::UnitZ(), {}};
    task.requirements.target = asked.target;
    task.requirements.measure.boxes = BoxModel::frame;
    result.tasks.push_back(std::move(task));
  }
  return result;
}

std::string study_plan_text(const std::vector<StudyTask>& tasks, const std::filesystem::path& folder) {
  std::string text = "{\"format\": \"stackabilize study\", \"version\": 1,\n \"tasks\": [";
  for (const StudyTask& task : tasks) {
    Json json = {{"name", task.name},
                 {"model", std::filesystem::proximate(task.model.path, folder).generic_string()}};
    if (task.direction != Eigen::Vector3d::UnitZ())
      json["direction"] = {task.direction.x(), task.direction.y(), task.direction.z()};
    json["target"] = task.requirements.target;
    if (!task.without.empty()) json["without"] = task.without;
    text += (&task == &tasks.front() ? "\n  " : ",\n  ") + json.dump();
  }
  return text + "\n ]}\n";
}

StructuredShape structured_shape(const StudyTask& task) {
  StructuredShape structured = analyse_structure(read_shape(task.model.path));
  if (task.without.empty()) return structured;
  return without_parts(structured, parts_named(structured.shape, task.without));
}

}  // namespace stackabilization::experiments
