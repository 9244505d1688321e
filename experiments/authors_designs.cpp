// Question: do we reach what the authors asked for and reached, with less change and as things to be built?
//
//     authors_designs --paper-data FOLDER [--effort E] [--threads N] [-o FOLDER]
//
// The main table has a row for each task of the authors' user study whose model is in the folder: the S that
// tasks.txt asks for along z, with the height kept and every limit of quality at its default. The table
// `results` has a row for each result of theirs that has the triangles of its model: the S that theirs has
// along z is asked for, and the change of both is the root mean square displacement of the vertices after the
// best similarity, over the diagonal. `theirs_breaks` names the limits that theirs does not keep. A model
// without S to ask for (theirs gains less than 0.01) has no row.

#include <Eigen/Geometry>
#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "common/asked_design.h"
#include "common/authors_targets.h"
#include "common/experiment.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/improvement/quality.h"
#include "stackabilization/improvement/shape_change.h"
#include "stackabilization/io/read.h"
#include "stackabilization/stacking/stackability.h"
#include "stackabilization/structure/analysis.h"

using namespace stackabilization;
using namespace stackabilization::experiments;

namespace fs = std::filesystem;

namespace {

const Direction upwards(0, 0, 1);
/// Gain of S below which a result of the authors asks for nothing.
constexpr double min_gain = 0.01;

/// The results of the authors that have the triangles of their model, by stem.
constexpr std::array<std::pair<const char*, const char*>, 5> results = {{{"100", "100_stackable_CB"},
                                                                         {"25", "25_stackable"},
                                                                         {"30", "30_stackable"},
                                                                         {"42", "42_stackable"},
                                                                         {"62", "62_stacked"}}};

Table& table_of(Report& report, const std::string& name, const std::vector<std::string>& more) {
  std::vector<Column> all = columns({"model", "input_hash"}, ColumnKind::key);
  for (const Column& column : columns({"target", "S_rest", "reached", "S", "D", "change_rms", "edits",
                                       "measure", "share_of_limit", "why"}))
    all.push_back(column);
  for (const Column& column : columns(more)) all.push_back(column);
  all.push_back({"first_seconds", ColumnKind::clock});
  all.push_back({"seconds", ColumnKind::clock});
  return report.table(name, all);
}

/// Asks one model for one target and adds a row; `more` are the values of the further columns.
void add_row(const fs::path& file, const std::string& name, double target, double effort,
             const std::vector<Cell>& more, Table& table) {
  const StructuredShape model = analyse_structure(read_shape(file));
  const double at_rest = stackability(model.shape, upwards).value;
  const AskedDesign asked = ask_for_design(model, upwards, target, effort);
  std::vector<Cell> row = {name,
                           file_hash(file),
                           target,
                           at_rest,
                           asked.reached(),
                           asked.best.measured.value,
                           asked.best.energy.distortion.total(),
                           asked.change,
                           static_cast<std::int64_t>(asked.best.design.edits.size()),
                           asked.measure,
                           asked.share_of_limit,
                           asked.why(model.structure)};
  row.insert(row.end(), more.begin(), more.end());
  row.insert(row.end(), {asked.first_seconds, asked.seconds});
  table.add(row);
}

/// Returns the limits of quality that a change does not keep, up to a similarity. Precondition: the same
/// triangles.
std::string broken_limits(const Shape& before, const Shape& after) {
  const Eigen::Matrix4d fit = Eigen::umeyama(Eigen::Matrix3Xd(after.vertices.transpose()),
                                             Eigen::Matrix3Xd(before.vertices.transpose()));
  const StructuredShape rest = analyse_structure(before);
  Shape now = rest.shape;
  now.vertices = (after.vertices * fit.topLeftCorner<3, 3>().transpose()).rowwise() +
                 fit.topRightCorner<3, 1>().transpose();
  std::string names;
  for (const QualityValue& value : QualityMeter(rest).measure(now))
    if (!is_within(value, {})) names += (names.empty() ? "" : " ") + name_of(value.measure);
  return names;
}

void compare_with_results(const fs::path& gallery, double effort, Report& report) {
  Table& table = table_of(report, "results", {"theirs_S", "theirs_change_rms", "theirs_breaks"});
  for (const auto& [stem, result] : results) try {
      const fs::path model = gallery / (std::string(stem) + ".obj");
      const Shape before = read_shape(model), after = read_shape(gallery / (std::string(result) + ".obj"));
      const double target = stackability(after, upwards).value;
      if (target < stackability(before, upwards).value + min_gain) continue;
      add_row(model, stem, target, effort,
              {target, shape_change(before, after).root_mean_square, broken_limits(before, after)}, table);
    } catch (const InputError& error) {
      report.failed(error.what());
    }
}

}  // namespace

int main(int argc, char** argv) {
  Experiment experiment(
      "authors_designs",
      "Do we reach what the authors asked for and reached, with less change and as things to be built?",
      Inputs::none);
  fs::path paper_data;
  double effort = 1;
  experiment.app().add_option("--paper-data", paper_data, "folder of the authors' data")->required();
  experiment.app().add_option("--effort", effort, "work of each run")->check(CLI::PositiveNumber);
  return experiment.run(argc, argv, [&](Report& report) {
    const auto targets = authors_targets(paper_data);
    const fs::path study = paper_data / "user-study-graphics" / "UserStudyApp" / "data" / "Tasks";
    Table& tasks = table_of(report, "", {});
    for (const fs::path& file : files_below(study, ".obj")) try {
        const auto target = targets.find(plain_task_name(file.stem().string()));
        if (target == targets.end()) continue;
        add_row(file, target->second.task, target->second.target, effort, {}, tasks);
      } catch (const InputError& error) {
        report.failed(error.what());
      }
    compare_with_results(paper_data / "stacker" / "data" / "RESULTS" / "Gallery", effort, report);
  });
}
