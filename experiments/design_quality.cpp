// Question: how many designs that a person would accept are found, and why are the others not?
//
//     design_quality [--gain G[,G...]] [--effort E] [--paper-data FOLDER] [--threads N] [-o FOLDER]
//     [MODEL...]
//
// Each model is asked for S + G along z, at most 0.9, with the height kept, every limit of quality at its
// default and no clock. A row says whether that was reached, the measure of quality that uses most of its
// limit, the change, the edits and, if it was not reached, whether the model is closed, the nearest design,
// what blocks it and the first remedy. A sheet per gain shows the model and its first solution side by side.

#include <algorithm>
#include <string>
#include <vector>

#include "common/asked_design.h"
#include "common/experiment.h"
#include "stackabilization/stacking/stackability.h"
#include "stackabilization/structure/analysis.h"

using namespace stackabilization;
using namespace stackabilization::experiments;

namespace {

/// Nobody asks for more.
constexpr double highest_target = 0.9;
const Direction upwards(0, 0, 1);

struct Settings {
  std::vector<double> gains = {0.1, 0.2, 0.3};
  double effort = 1;
};

Table& table_of(Report& report) {
  std::vector<Column> all = columns({"model", "input_hash", "gain"}, ColumnKind::key);
  for (const Column& column : columns({"S_rest", "target", "reached", "closed", "S", "D", "change_rms",
                                       "edits", "measure", "share_of_limit", "why", "remedy"}))
    all.push_back(column);
  all.push_back({"seconds", ColumnKind::clock});
  return report.table("", all);
}

/// Asks one model for one gain, and adds a row and the tiles of the sheet.
void ask(const ModelFile& file, const StructuredShape& model, const std::string& hash, double gain,
         const Settings& settings, Table& table, Sheet& sheet) {
  const double at_rest = stackability(model.shape, upwards).value;
  const double target = std::min(highest_target, at_rest + gain);
  const AskedDesign asked = ask_for_design(model, upwards, target, settings.effort);
  const Candidate& best = asked.best;
  const bool closed = asked.found.diagnosis && asked.found.diagnosis->closed;
  table.add({file.name, hash, gain, at_rest, target, asked.reached(), closed, best.measured.value,
             best.energy.distortion.total(), asked.change,
             static_cast<std::int64_t>(best.design.edits.size()), asked.measure, asked.share_of_limit,
             asked.why(model.structure), asked.remedy(model.structure), asked.seconds});
  if (asked.reached() && !file.authors) {
    sheet.tiles.push_back({model.shape, {file.name, "at rest"}, true});
    sheet.tiles.push_back({best.design.shape, {file.name, "S + " + std::to_string(gain).substr(0, 4)}});
  }
}

}  // namespace

int main(int argc, char** argv) {
  Experiment experiment("design_quality",
                        "How many designs that a person would accept are found, and why are the others not?");
  Settings settings;
  experiment.app().add_option("--gain", settings.gains, "gains in S to ask for")->delimiter(',');
  experiment.app().add_option("--effort", settings.effort, "work of each run")->check(CLI::PositiveNumber);
  return experiment.run(argc, argv, [&](Report& report) {
    Table& table = table_of(report);
    const std::vector<ModelFile> models = experiment.models();
    for (const double gain : settings.gains) {
      Sheet sheet{
          "Designs within every limit of quality, S + " + std::to_string(gain).substr(0, 4), upwards, {}};
      for_each_model(models, report, [&](const ModelFile& file, const Shape& shape, const std::string& hash) {
        ask(file, analyse_structure(shape), hash, gain, settings, table, sheet);
      });
      if (!sheet.tiles.empty()) report.sheet("gain_" + std::to_string(gain).substr(2, 2), std::move(sheet));
    }
  });
}
