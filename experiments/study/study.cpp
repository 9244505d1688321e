// Question: what does the automatic method gain over editing by hand, with the same tool?
//
//     study [--seeds N] [--edits N] [--compared N] [--expansions N] [--threads N] [--paper-data FOLDER]
//           [--people FILE] [-o FOLDER] [TASK...]
//     study --write-plan FILE [--paper-data FOLDER] [TASK...]
//
// After the user study of the paper (section 6), with simulated users instead of people. TASK is one of seven
// objects of the shipped models, each with a target for S along one direction; with --paper-data those of the
// authors' study too whose models are in the folder. Each task is done by the automatic method with the
// presets paper and refined, and by users (study/manual_work.h) of three habits and `--seeds` seeds, who make
// random edits with the same handles, operations, deformation model and constraints, see S after each, and
// give up after `--edits` of them: 200, an hour at 18 seconds for taking hold, dragging, waiting, looking,
// and keeping or undoing. One row per task, user and seed; `summary`: medians and quartiles. `edits_tried` of
// the automatic method is the number of designs that it made. With --people, those who did the
// tasks in the editor (`stackabilize edit experiments/study/plan.json --study FILE --boxes frame`) have rows
// too, with the number of the participant as seed. --write-plan makes the plan of these tasks for people, and
// nobody does them: those of the authors' study with --paper-data, whose names begin with authors/.

#include "stackabilization/editing/study.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <iostream>
#include <memory>

#include "common/clock.h"
#include "common/experiment.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/factory.h"
#include "stackabilization/improvement/shape_change.h"
#include "stackabilization/io/read_file.h"
#include "stackabilization/io/write_file.h"
#include "study/automatic_work.h"
#include "study/manual_work.h"
#include "study/study_summary.h"

namespace stackabilization::experiments {
namespace {

struct Settings {
  int seeds = 20, edits = 200, compared = 8;
  std::int64_t expansions = 40;
  std::filesystem::path paper_data, people, plan;
  std::vector<std::string> names;
};

/// Everybody at one task.
class TaskStudy {
 public:
  TaskStudy(const StudyTask& task, const Settings& settings)
      : task_(task),
        settings_(settings),
        hash_(file_hash(task.model.path)),
        space_(deformation_model(structured_shape(task))),
        checker_(*space_, task.requirements),
        tool_(checker_, task.direction) {}

  std::vector<StudyRun> runs() const {
    std::vector<StudyRun> all = {automatic(ImprovementPreset::paper, "automatic, paper"),
                                 automatic(ImprovementPreset::refined, refined_user)};
    for (const Habit habit : {Habit::random, Habit::greedy, Habit::careful})
      for (StudyRun& run : manual(habit)) all.push_back(std::move(run));
    return all;
  }

 private:
  StudyRun automatic(ImprovementPreset preset, const std::string& user) const {
    ImprovementOptions options;
    options.preset = preset;
    options.search.expansions = settings_.expansions;
    const Stopwatch watch;
    const AutomaticWork work = automatic_work(*space_, task_, options);
    StudyRun run = run_of(user, work.result);
    run.processor_seconds = watch.processor_seconds();
    run.reached = work.reached;
    run.tried = work.tried;
    return run;
  }

  std::vector<StudyRun> manual(Habit habit) const {
    const Stopwatch watch;
    std::vector<StudyRun> runs(static_cast<std::size_t>(settings_.seeds));
    tbb::parallel_for(std::size_t{0}, runs.size(),
                      [&](std::size_t k) { runs[k] = manual(habit, static_cast<unsigned>(k + 1)); });
    const double each = watch.processor_seconds() / settings_.seeds;
    for (StudyRun& run : runs) run.processor_seconds = each;
    return runs;
  }

  StudyRun manual(Habit habit, unsigned seed) const {
    const ManualWork work = worked(tool_, {habit, seed, settings_.edits, settings_.compared});
    StudyRun run = run_of(name_of(habit), work.result);
    run.seed = seed;
    run.reached = work.reached;
    run.tried = work.tried;
    return run;
  }

  StudyRun run_of(const std::string& user, const Candidate& result) const {
    StudyRun run;
    run.task = task_.name;
    run.model = task_.model.name;
    run.input_hash = hash_;
    run.user = user;
    run.target = task_.requirements.target;
    run.before = tool_.at_rest().measured.value;
    run.stackability = result.measured.value;
    run.energy = result.energy;
    run.change = shape_change(space_->rest().shape, result.design.shape).root_mean_square;
    run.kept = static_cast<std::int64_t>(result.design.edits.size());
    return run;
  }

  const StudyTask& task_;
  const Settings& settings_;
  std::string hash_;
  std::unique_ptr<DeformationModel> space_;
  RequirementChecker checker_;
  ManualTool tool_;
};

std::vector<StudyTask> tasks_of(const Settings& settings) {
  std::vector<StudyTask> tasks = shipped_tasks();
  if (!settings.paper_data.empty()) {
    AuthorsTasks authors = authors_tasks(settings.paper_data);
    for (const std::string& name : authors.absent)
      std::cerr << "study: " << settings.paper_data.string() << ": no model for the task '" << name
                << "', it is left out\n";
    tasks.insert(tasks.end(), authors.tasks.begin(), authors.tasks.end());
  }
  if (settings.names.empty()) return tasks;
  std::vector<StudyTask> chosen;
  for (const std::string& name : settings.names) {
    const auto found =
        std::find_if(tasks.begin(), tasks.end(), [&](const StudyTask& task) { return task.name == name; });
    if (found == tasks.end()) throw UsageError("'" + name + "' is no task");
    chosen.push_back(*found);
  }
  return chosen;
}

/// Adds what people came to in the tasks of the runs.
void add_people(const std::filesystem::path& file, std::vector<StudyRun>& runs) {
  const std::vector<StudyRun> tasks = runs;
  for (const editing::StudyResult& result : editing::study_results(read_file(file), file.string())) {
    const auto task = std::find_if(tasks.begin(), tasks.end(),
                                   [&](const StudyRun& run) { return run.task == result.task; });
    if (task == tasks.end()) continue;
    StudyRun run = *task;
    run.user = "person, " + name_of(result.condition);
    run.seed = result.participant;
    run.target = result.target;
    run.reached = result.reached;
    run.stackability = result.stackability;
    run.energy = {};
    run.energy.distortion = result.distortion;
    run.change = result.change;
    run.kept = result.edits;
    run.tried = result.made;
    run.processor_seconds = 0;
    runs.push_back(std::move(run));
  }
}

void add_options(Settings& settings, CLI::App& app) {
  app.add_option("--seeds", settings.seeds, "simulated users of each habit, seeds 1, 2 ...")
      ->check(CLI::Range(1, 10000));
  app.add_option("--edits", settings.edits, "edits that a user tries before giving up")
      ->check(CLI::Range(1, 1000000));
  app.add_option("--compared", settings.compared, "edits that a user compares before keeping one")
      ->check(CLI::Range(1, 1000));
  app.add_option("--expansions", settings.expansions, "limit of the searches of the automatic method")
      ->check(CLI::PositiveNumber);
  app.add_option("--paper-data", settings.paper_data,
                 "folder of the authors' data; tasks of their study too");
  app.add_option("--people", settings.people,
                 "CSV of `stackabilize edit --study`: people who did tasks of these names");
  app.add_option("--write-plan", settings.plan,
                 "write the plan of the tasks for `stackabilize edit --study`, and do nothing else");
  app.add_option("tasks", settings.names, "names of tasks; by default all")->type_name("TASK");
}

}  // namespace
}  // namespace stackabilization::experiments

int main(int argc, char** argv) {
  using namespace stackabilization;
  using namespace stackabilization::experiments;
  Experiment experiment(
      "study", "What does the automatic method gain over editing by hand, with the same tool?", Inputs::none);
  Settings settings;
  add_options(settings, experiment.app());
  return experiment.run(argc, argv, [&](Report& report) {
    std::vector<StudyRun> runs;
    const std::vector<StudyTask> tasks = tasks_of(settings);
    if (!settings.plan.empty())
      return write_file_atomically(settings.plan, study_plan_text(tasks, settings.plan.parent_path()));
    for (const StudyTask& task : tasks) try {
        for (StudyRun& run : TaskStudy(task, settings).runs()) runs.push_back(std::move(run));
      } catch (const InputError& error) {
        report.failed(error.what());
      }
    if (!settings.people.empty()) add_people(settings.people, runs);
    report_study(runs, report);
  });
}
