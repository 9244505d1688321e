// Question: which deformation model pays least for stackability?
//
//     deformation_models [--targets T,...] [--alphas A,...] [--deformations NAME,...] [--expansions N]
//                        [--evaluations N] [--seconds T] [--threads N] [--paper-data FOLDER] [-o FOLDER]
//                        [MODEL...]
//
// Every model is deformed in every way - controllers with cuboids, with generalized cylinders, and with what
// the analysis chooses (mixed); surface; iWires; gap scaling - to reach the same targets along z, in boxes of
// the file, under the same requirements and limits. A target T is that fraction of the way from S at rest to
// 1. Controllers also in the paper's steps, the mixed ones with every alpha.
//
// D is defined on primitives. So that it means the same for all, each mesh is measured with the primitives of
// the mixed structure carried along (carried_design.h); D_of_its_own is what the search saw. The change is
// that of the vertices after the best similarity fit (shape_change.h), and knows no structure at all.
//
// One row per task: its best solution, or where there is none, what came nearest and why. `summary`: by
// variant over all models, costs as medians of the ratio to the mixed variant, and of the refined preset to
// the paper's, over what both reached. `alpha`: by alpha, over what was reached with all of them. Sheets: the
// designs of the middle target.

#include <algorithm>

#include "deformation_models/findings.h"

namespace stackabilization::experiments {
namespace {

struct Settings {
  Limits limits;
  std::vector<double> targets = {0.1, 0.2, 0.35};
  std::vector<double> alphas = {0, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 0.95};
  std::vector<std::string> deformations;

  bool wants(const Variant& variant) const {
    return deformations.empty() ||
           std::find(deformations.begin(), deformations.end(), variant.name) != deformations.end();
  }
};

std::vector<Task> tasks(const Subject& subject, const Settings& settings, ImprovementPreset preset,
                        double alpha) {
  std::vector<Task> result;
  for (const double fraction : settings.targets) {
    const double rest = subject.stackability_at_rest();
    result.push_back({preset, alpha, fraction, rest + fraction * (1 - rest)});
  }
  return result;
}

/// Controllers in both presets, everything else in the refined one.
std::vector<Task> tasks_of(const Variant& variant, const Subject& subject, const Settings& settings) {
  std::vector<Task> all;
  if (capabilities_of(variant.kind).edits_primitives)
    all = tasks(subject, settings, ImprovementPreset::paper, common_alpha);
  for (const Task& task : tasks(subject, settings, ImprovementPreset::refined, common_alpha))
    all.push_back(task);
  return all;
}

std::vector<Trial> swept(const Subject& subject, const Settings& settings) {
  std::vector<Task> all;
  for (const double alpha : settings.alphas)
    if (alpha != common_alpha)
      for (const Task& task : tasks(subject, settings, ImprovementPreset::paper, alpha)) all.push_back(task);
  return subject.trials(mixed_variant(), all, settings.limits);
}

/// Is the variant the mixed one, or the same because the analysis chooses its kind for every part?
bool is_mixed(const Variant& variant, const Subject& subject) {
  return variant.name == mixed_variant().name ||
         (variant.primitives && subject.consists_of(*variant.primitives));
}

/// All variants that are wanted; what is the mixed one is tried once.
std::vector<Trial> compared(const Subject& subject, const Settings& settings) {
  std::vector<Trial> all, of_mixed;
  for (const Variant& variant : variants()) {
    if (!settings.wants(variant)) continue;
    std::vector<Trial> trials;
    const bool same = is_mixed(variant, subject);
    if (same && !of_mixed.empty())
      trials = of_mixed;
    else
      trials = subject.trials(variant, tasks_of(variant, subject, settings), settings.limits);
    if (same) of_mixed = trials;
    for (Trial& trial : trials) {
      trial.variant = variant.name;
      all.push_back(std::move(trial));
    }
  }
  return all;
}

Findings examine(const Shape& shape, const Settings& settings) {
  const Subject subject(shape);
  Findings findings;
  findings.stackability_at_rest = subject.stackability_at_rest();
  findings.rest = subject.shape();
  findings.shown_fraction = settings.targets[settings.targets.size() / 2];
  findings.trials = compared(subject, settings);
  if (settings.wants(mixed_variant())) findings.alphas = swept(subject, settings);
  return findings;
}

void add_options(CLI::App& app, Settings& settings) {
  std::vector<std::string> names;
  for (const Variant& variant : variants()) names.push_back(variant.name);
  const auto listed = [](CLI::Option* option) { option->delimiter(',')->allow_extra_args(false); };
  listed(app.add_option("--targets", settings.targets, "fractions of the way from S at rest to 1")
             ->check(CLI::Range(0.01, 0.99)));
  listed(app.add_option("--alphas", settings.alphas, "alpha of Eq. 5 in the paper's steps")
             ->check(CLI::Range(0.0, 1.0)));
  listed(app.add_option("--deformations", settings.deformations, "only these (default: all)")
             ->check(CLI::IsMember(names)));
  app.add_option("--expansions", settings.limits.expansions, "limit of each search")
      ->check(CLI::PositiveNumber);
  app.add_option("--evaluations", settings.limits.evaluations, "limit of each refinement")
      ->check(CLI::Range(10, 100000));
  app.add_option("--seconds", settings.limits.seconds,
                 "limit of each task; what it ends is not the same again")
      ->check(CLI::PositiveNumber);
}

}  // namespace
}  // namespace stackabilization::experiments

int main(int argc, char** argv) {
  using namespace stackabilization;
  using namespace stackabilization::experiments;
  Experiment experiment("deformation_models", "Which deformation model pays least for stackability?");
  experiment.use_by_default({"cup", "mug_with_handle", "table"});
  Settings settings;
  add_options(experiment.app(), settings);
  return experiment.run(argc, argv, [&](Report& report) {
    std::vector<Findings> models;
    for_each_model(experiment.models(), report,
                   [&](const ModelFile& model, const Shape& shape, const std::string& hash) {
                     Findings findings = examine(shape, settings);
                     findings.model = model.name;
                     findings.hash = hash;
                     add_rows(findings, report);
                     models.push_back(std::move(findings));
                   });
    summarise(models, report);
  });
}
