// Question: how many pixels does a sampled gap function need?
//
//     envelope_accuracy [--directions N] [--fine-directions N] [--paper-data FOLDER] [-o FOLDER] [MODEL...]
//
// f_max and S by CPU raster, OpenGL raster and AABB-tree rays at 32 to 4096 samples a side, and with the
// framing of the authors' program, against the exact values (solid semantics, oriented boxes), along z and
// evenly spread directions. The finest samplings are made along the first --fine-directions only.
//
// Tables: one row per model, direction and sampling; `models` and `summary`, errors and order of convergence
// by model and for all together, with the worst case and its reason (see accuracy/shortfall.h); `reasons` and
// `needed` for all together; with --paper-data also `study`, what the authors' resolution makes of their
// targets.

#include <iterator>

#include "accuracy/accuracy_summary.h"
#include "accuracy/study_targets.h"
#include "common/lattice.h"
#include "stackabilization/stacking/stackability.h"

namespace stackabilization::experiments {
namespace {

struct Settings {
  int directions = 16, fine_directions = 4;
};

Table& main_table(Report& report) {
  std::vector<Column> all =
      columns({"model", "input_hash", "x", "y", "z", "method", "samples"}, ColumnKind::key);
  for (const Column& column : columns({"samples_across", "h", "f_exact", "f_sampled", "error_over_h",
                                       "S_exact", "S_error", "reason", "missed_width_pixels"}))
    all.push_back(column);
  all.push_back({"cpu_ms", ColumnKind::clock});
  return report.table("", all);
}

std::vector<Direction> directions_of(int count) {
  std::vector<Direction> directions{Direction(0, 0, 1)};
  for (const Direction& direction : hemisphere_lattice(count - 1)) directions.push_back(direction);
  return directions;
}

std::vector<Accuracy> along(const StackabilitySolver& solver, const std::vector<Sampler>& samplers,
                            const Direction& direction, bool one_of_few) {
  const Stackability exact = solver.measure(direction);
  const Separation solid = solver.separation(direction);
  const Separation closed =
      separation(solver.tree(), solver.tree(), direction, {ContactSemantics::closed, {}});
  std::vector<Accuracy> rows;
  if (!solid.blocked) return rows;
  for (Sampling& sampling : sample_all(solver.shape(), samplers, direction, one_of_few)) {
    Accuracy row{direction.vector(), std::move(sampling), exact.extent, solid.length, 0, exact.value, 0, {}};
    row.error = (row.sampling.f_max - solid.length) / exact.extent;
    row.S_error = -row.error * exact.stack_box_volume() / exact.box_volume;
    row.shortfall = shortfall(solver.shape(), direction, row.sampling, solid, closed);
    rows.push_back(std::move(row));
  }
  return rows;
}

void add_rows(const AccuracyOfModel& model, Table& table) {
  for (const Accuracy& row : model.rows) {
    const Sampling& sampling = row.sampling;
    table.add({model.model, model.hash, row.direction.x(), row.direction.y(), row.direction.z(),
               sampling.method, std::int64_t{sampling.samples}, sampling.across, row.extent, row.exact,
               sampling.f_max, row.error, row.S_exact, row.S_error, row.shortfall.reason,
               row.shortfall.width ? Cell(*row.shortfall.width) : Cell(), 1e3 * sampling.processor_seconds});
  }
}

void measure(const Experiment& experiment, const Settings& settings, Report& report) {
  const std::vector<Direction> directions = directions_of(settings.directions);
  Table& table = main_table(report);
  std::vector<AccuracyOfModel> models;
  for_each_model(experiment.models(), report,
                 [&](const ModelFile& file, const Shape& shape, const std::string& hash) {
                   const StackabilitySolver solver(shape);
                   const std::vector<Sampler> all = samplers(shape);
                   AccuracyOfModel model{file.name, hash, {}};
                   for (std::size_t d = 0; d < directions.size(); ++d) {
                     const bool one_of_few = d < static_cast<std::size_t>(settings.fine_directions);
                     auto rows = along(solver, all, directions[d], one_of_few);
                     std::move(rows.begin(), rows.end(), std::back_inserter(model.rows));
                   }
                   add_rows(model, table);
                   models.push_back(std::move(model));
                 });
  summarise(models, report);
  if (!experiment.paper_data().empty()) compare_study_targets(experiment.paper_data(), report);
}

}  // namespace
}  // namespace stackabilization::experiments

int main(int argc, char** argv) {
  using namespace stackabilization;
  using namespace stackabilization::experiments;
  Experiment experiment("envelope_accuracy", "How many pixels does a sampled gap function need?");
  Settings settings;
  experiment.app()
      .add_option("--directions", settings.directions, "directions per model: z, and others spread evenly")
      ->check(CLI::Range(2, 100000));
  experiment.app()
      .add_option("--fine-directions", settings.fine_directions,
                  "of these, how many see the finest samplings")
      ->check(CLI::Range(0, 100000));
  return experiment.run(argc, argv, [&](Report& report) { measure(experiment, settings, report); });
}
