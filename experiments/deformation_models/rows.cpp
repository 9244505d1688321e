#include <cmath>

#include "common/sheet.h"
#include "deformation_models/findings.h"
#include "stackabilization/core/number_text.h"

namespace stackabilization::experiments {
namespace {

Table& main_table(Report& report) {
  std::vector<Column> all = columns(
      {"model", "input_hash", "deformation", "preset", "alpha", "fraction", "target"}, ColumnKind::key);
  for (const Column& column :
       columns({"reached", "S", "D", "D_vol", "D_prox", "D_BB", "D_symm", "D_of_its_own", "change_rms",
                "change_largest", "edits", "evaluated", "reason"}))
    all.push_back(column);
  for (const Column& column : columns({"cpu_seconds", "seconds"}, ColumnKind::clock)) all.push_back(column);
  return report.table("", all);
}

void add_row(const Findings& findings, const Trial& trial, Table& table) {
  const Task& task = trial.task;
  std::vector<Cell> row = {findings.model, findings.hash, trial.variant, preset_name(task.preset),
                           task.alpha,     task.fraction, task.target,   trial.reached};
  if (trial.best) {
    const Distortion& d = trial.best->distortion;
    for (const double value :
         {trial.best->stackability, d.total(), d.volume, d.proximity, d.box, d.symmetry,
          trial.best->own_distortion, trial.best->change.root_mean_square, trial.best->change.largest})
      row.emplace_back(value);
    row.emplace_back(trial.best->edits);
    row.emplace_back(trial.evaluated);
  }
  row.resize(table.columns().size() - 3);
  for (const Cell& cell : {Cell(trial.reason), Cell(trial.processor_seconds), Cell(trial.seconds)})
    row.push_back(cell);
  table.add(std::move(row));
}

SheetTile tile_of(const Trial& trial) {
  const Measures& best = *trial.best;
  return {trial.shape,
          {trial.variant,
           std::string(trial.reached ? "S " : "not reached: S ") + fixed_text(best.stackability, 3),
           "D " + fixed_text(best.distortion.total(), 4) + ", change " +
               fixed_text(best.change.root_mean_square, 4)}};
}

/// The designs of all variants for one target.
Sheet sheet_of(const Findings& findings) {
  Sheet sheet{findings.model, Direction(0, 0, 1), {}};
  sheet.tiles.push_back({findings.rest, {"at rest", "S " + fixed_text(findings.stackability_at_rest, 3)}});
  for (const Trial& trial : findings.trials)
    if (trial.task.preset == ImprovementPreset::refined && trial.task.fraction == findings.shown_fraction &&
        trial.best) {
      sheet.title = findings.model + ", asked for S = " + fixed_text(trial.task.target, 3);
      sheet.tiles.push_back(tile_of(trial));
    }
  return sheet;
}

}  // namespace

std::string preset_name(ImprovementPreset preset) {
  return preset == ImprovementPreset::paper ? "paper" : "refined";
}

void add_rows(const Findings& findings, Report& report) {
  Table& table = main_table(report);
  for (const std::vector<Trial>* trials : {&findings.trials, &findings.alphas})
    for (const Trial& trial : *trials) add_row(findings, trial, table);
  report.sheet(findings.model, sheet_of(findings));
}

}  // namespace stackabilization::experiments
