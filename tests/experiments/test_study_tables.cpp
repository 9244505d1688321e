#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "stackabilization/core/errors.h"
#include "stackabilization/editing/study.h"
#include "stackabilization/io/read_file.h"
#include "study/study_summary.h"
#include "study/study_tasks.h"
#include "support/catch.h"

using namespace stackabilization;
using namespace stackabilization::experiments;
namespace fs = std::filesystem;

namespace {

StudyRun run_of(const std::string& task, const std::string& user, double S, double D) {
  StudyRun run;
  run.task = task;
  run.user = user;
  run.target = 0.5;
  run.stackability = S;
  run.reached = S >= run.target;
  run.energy.distortion.volume = 4 * D;
  return run;
}

double number(const Cell& cell) {
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*whole);
  return std::get<double>(cell);
}

/// The cell of the row of this task and user.
Cell cell(const Table& table, const std::string& task, const std::string& user, const std::string& column) {
  std::size_t place = 0;
  while (table.columns().at(place).name != column) ++place;
  for (const auto& row : table.rows())
    if (std::get<std::string>(row[0]) == task && std::get<std::string>(row[1]) == user) return row[place];
  throw std::out_of_range("no such row");
}

/// A folder like that of the authors' data.
struct AuthorsFolder {
  fs::path root = fs::temp_directory_path() / ("experiments_study_" + std::to_string(getpid()));

  AuthorsFolder() {
    fs::remove_all(root);
    fs::create_directories(root / "user-study-graphics/UserStudyApp/data/Tasks");
  }
  ~AuthorsFolder() {
    std::error_code ignored;
    fs::remove_all(root, ignored);
  }
  AuthorsFolder(const AuthorsFolder&) = delete;
  AuthorsFolder& operator=(const AuthorsFolder&) = delete;

  void write(const std::string& path, const std::string& text) const {
    fs::create_directories((root / path).parent_path());
    std::ofstream(root / path) << text;
  }
};

}  // namespace

TEST_CASE("a summary has shares and quartiles per task and over all tasks, and says who did better") {
  std::vector<StudyRun> runs = {run_of("cup", refined_user, 0.5, 0.1), run_of("stool", refined_user, 0.3, 0)};
  const double S[] = {0.1, 0.6, 0.5, 0.7}, D[] = {0.4, 0.05, 0.2, 0.3};
  for (int k = 0; k < 4; ++k) runs.push_back(run_of("cup", "random", S[k], D[k]));
  runs.push_back(run_of("stool", "random", 0.4, 1));
  runs.push_back(run_of("stool", "random", 0.2, 0));
  Report report;
  report_study(runs, report);
  const Table& table = report.table("summary", {});
  CHECK(number(cell(table, "cup", "random", "runs")) == 4);
  CHECK(number(cell(table, "cup", "random", "reached")) == 0.75);
  CHECK(number(cell(table, "cup", "random", "S_median")) == 0.5);
  CHECK(number(cell(table, "cup", "random", "S_upper")) == 0.6);
  CHECK(number(cell(table, "cup", "random", "way_lower")) == Approx(0.2));
  CHECK(number(cell(table, "cup", "random", "D_median")) == Approx(0.2));
  CHECK(number(cell(table, "cup", "random", "D_median_where_reached")) == Approx(0.2));
  // Not better than the one that reached the target with D = 0.05.
  CHECK(number(cell(table, "cup", "random", "refined_beats_D")) == 0.75);
  // Nobody reached the target: more S is better.
  CHECK(number(cell(table, "stool", "random", "refined_beats_D")) == 0.5);
  CHECK(std::holds_alternative<std::monostate>(cell(table, "stool", "random", "D_median_where_reached")));
  // Changes are all the same, so that only those who missed the target are beaten.
  CHECK(number(cell(table, "cup", "random", "refined_beats_change_rms")) == 0.25);
  CHECK(number(cell(table, "all", "random", "reached")) == 0.5);
  CHECK(number(cell(table, "all", refined_user, "refined_beats_D")) == 0);
  CHECK(std::holds_alternative<std::monostate>(cell(table, "all", "random", "S_median")));
}

TEST_CASE("a study without a run has a table without rows") {
  Report report;
  report_study({}, report);
  CHECK(report.table("", {}).rows().empty());
  CHECK_FALSE(report.table("", {}).columns().empty());
}

TEST_CASE("there are seven tasks of shipped models, each with a target") {
  const std::vector<StudyTask> tasks = shipped_tasks();
  CHECK(tasks.size() == 7);
  for (const StudyTask& task : tasks) {
    CHECK(fs::is_regular_file(task.model.path));
    CHECK(task.requirements.target > 0.2);
    CHECK(task.requirements.target < 1);
  }
}

TEST_CASE("the plan for people has the tasks of the simulated users") {
  const fs::path plan_file = fs::path(STACKABILIZATION_SOURCE_DIR) / "experiments/study/plan.json";
  const std::vector<StudyTask> tasks = shipped_tasks();
  CHECK(read_file(plan_file) == study_plan_text(tasks, plan_file.parent_path()));
  const fs::path folder = fs::path(STACKABILIZATION_BINARY_DIR) / "plans";
  const std::string elsewhere = study_plan_text(tasks, folder);
  const editing::StudyPlan plan = editing::study_plan_of_text(elsewhere, "plan.json");
  REQUIRE(plan.tasks.size() == tasks.size());
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    CHECK(plan.tasks[k].name == tasks[k].name);
    CHECK(fs::weakly_canonical(folder / plan.tasks[k].model) == fs::weakly_canonical(tasks[k].model.path));
    CHECK(plan.tasks[k].direction == tasks[k].direction);
    CHECK(plan.tasks[k].target == tasks[k].requirements.target);
    CHECK(plan.tasks[k].without == tasks[k].without);
  }
}

TEST_CASE("parts that a task leaves out are gone, with what holds on to them") {
  for (const StudyTask& task : shipped_tasks()) {
    if (task.without.empty()) continue;
    const StructuredShape all = structured_shape({task.name, task.model, {}, task.direction, {}});
    const StructuredShape left = structured_shape(task);
    CHECK(left.structure.parts.size() == all.structure.parts.size() - task.without.size());
    CHECK(left.structure.relations.size() < all.structure.relations.size());
    StudyTask wrong = task;
    wrong.without = {"wing"};
    CHECK_THROWS_AS(structured_shape(wrong), InputError);
  }
}

TEST_CASE("the authors' tasks are found by their names, and those without a model are named") {
  const AuthorsFolder folder;
  CHECK_THROWS_AS(authors_tasks(folder.root / "nowhere"), InputError);
  folder.write("user-study-graphics/UserStudyApp/data/Tasks/cup-handle-01.obj", "");
  folder.write("user-study-graphics/UserStudyApp/data/table-midbar.obj", "");
  folder.write("elsewhere/chair.obj", "");
  CHECK_THROWS_AS(authors_tasks(folder.root), InputError);
  folder.write("user-study-graphics/UserStudyApp/tasks.txt",
               "data/Tasks/cup-handle.obj 0.51\r\ndata/Tasks/chair.obj 0.65\n\n"
               "data/Tasks/table-middlebar.obj 0.65\n");
  const AuthorsTasks found = authors_tasks(folder.root);
  REQUIRE(found.tasks.size() == 2);
  CHECK(found.tasks[0].name == "authors/cup-handle");
  CHECK(found.tasks[0].model.path.filename() == "cup-handle-01.obj");
  CHECK(found.tasks[0].model.authors);
  CHECK(found.tasks[0].requirements.target == 0.51);
  CHECK(found.tasks[0].requirements.measure.boxes == BoxModel::frame);
  CHECK(found.tasks[1].name == "authors/table-middlebar");
  CHECK(found.absent == std::vector<std::string>{"chair"});
  folder.write("user-study-graphics/UserStudyApp/tasks.txt", "data/Tasks/cup-handle.obj much\n");
  CHECK_THROWS_AS(authors_tasks(folder.root), InputError);
}
