#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>

#include "common/statistics.h"
#include "deformation_models/findings.h"

namespace stackabilization::experiments {
namespace {

/// What a design costs.
using Cost = double (*)(const Measures&);
double distortion(const Measures& measures) {
  return measures.distortion.total();
}
double change(const Measures& measures) {
  return measures.change.root_mean_square;
}

/// What the refined preset makes small.
double both(const Measures& measures) {
  return distortion(measures) + change(measures);
}
constexpr std::array<Cost, 3> costs{distortion, change, both};

/// A target for a model.
using Target = std::pair<std::string, double>;
/// What a variant reached, by target.
using Reached = std::map<Target, Measures>;

struct Kind {
  std::string variant;
  ImprovementPreset preset = ImprovementPreset::refined;
  auto operator<=>(const Kind&) const = default;
};

class Comparison {
 public:
  explicit Comparison(const std::vector<Findings>& models) {
    for (const Findings& findings : models)
      for (const Trial& trial : findings.trials) {
        const Kind kind{trial.variant, trial.task.preset};
        ++tasks_[kind];
        Reached& reached = reached_[kind];
        if (trial.reached) reached[{findings.model, trial.task.fraction}] = *trial.best;
      }
  }

  int tasks(const Kind& kind) const {
    const auto found = tasks_.find(kind);
    return found == tasks_.end() ? 0 : found->second;
  }
  const Reached& reached(const Kind& kind) const { return reached_.at(kind); }

  /// Median, over the targets that both reached, of the cost of one over that of the other.
  Cell ratio(const Kind& kind, const Kind& other, Cost cost) const {
    std::vector<double> ratios;
    if (tasks(other) == 0) return {};
    for (const auto& [target, measures] : reached(kind)) {
      const auto found = reached(other).find(target);
      if (found != reached(other).end() && cost(found->second) > 0)
        ratios.push_back(cost(measures) / cost(found->second));
    }
    return ratios.empty() ? Cell() : Cell(median(ratios));
  }

  /// How often nothing else with this preset reached the target at a lower cost.
  std::int64_t least(const Kind& kind, Cost cost) const {
    std::int64_t count = 0;
    for (const auto& [target, measures] : reached(kind)) {
      double lowest = std::numeric_limits<double>::infinity();
      for (const auto& [other, others] : reached_)
        if (const auto found = others.find(target); other.preset == kind.preset && found != others.end())
          lowest = std::min(lowest, cost(found->second));
      if (cost(measures) <= lowest) ++count;
    }
    return count;
  }

 private:
  std::map<Kind, int> tasks_;
  std::map<Kind, Reached> reached_;
};

void add_summary(const std::vector<Findings>& models, Report& report) {
  const Comparison comparison(models);
  std::vector<Column> all = columns({"deformation", "preset"}, ColumnKind::key);
  for (const Column& column :
       columns({"tasks", "reached", "D_over_mixed", "change_over_mixed", "both_over_mixed", "least_D",
                "least_change", "least_both", "D_over_paper", "change_over_paper", "both_over_paper"}))
    all.push_back(column);
  Table& table = report.table("summary", all);
  for (const Variant& variant : variants())
    for (const ImprovementPreset preset : {ImprovementPreset::paper, ImprovementPreset::refined}) {
      const Kind kind{variant.name, preset}, paper{variant.name, ImprovementPreset::paper};
      if (comparison.tasks(kind) == 0) continue;
      const bool refined = preset == ImprovementPreset::refined;
      std::vector<Cell> row = {variant.name, preset_name(preset), std::int64_t{comparison.tasks(kind)},
                               static_cast<std::int64_t>(comparison.reached(kind).size())};
      for (const Cost cost : costs)
        row.push_back(comparison.ratio(kind, {mixed_variant().name, preset}, cost));
      for (const Cost cost : costs) row.emplace_back(comparison.least(kind, cost));
      for (const Cost cost : costs) row.push_back(refined ? comparison.ratio(kind, paper, cost) : Cell());
      table.add(std::move(row));
    }
}

/// What the mixed variant reached in the paper's steps with one alpha, by target.
std::map<double, std::map<Target, Trial>> by_alpha(const std::vector<Findings>& models) {
  std::map<double, std::map<Target, Trial>> result;
  for (const Findings& findings : models)
    for (const std::vector<Trial>* trials : {&findings.trials, &findings.alphas})
      for (const Trial& trial : *trials)
        if (trial.variant == mixed_variant().name && trial.task.preset == ImprovementPreset::paper)
          result[trial.task.alpha][{findings.model, trial.task.fraction}] = trial;
  return result;
}

/// The targets that were reached with every alpha.
std::set<Target> always_reached(const std::map<double, std::map<Target, Trial>>& trials) {
  std::map<Target, std::size_t> counts;
  for (const auto& [alpha, of_alpha] : trials)
    for (const auto& [target, trial] : of_alpha)
      if (trial.reached) ++counts[target];
  std::set<Target> result;
  for (const auto& [target, count] : counts)
    if (count == trials.size()) result.insert(target);
  return result;
}

void add_alphas(const std::vector<Findings>& models, Report& report) {
  std::vector<Column> all = columns({"alpha"}, ColumnKind::key);
  for (const Column& column : columns({"tasks", "reached", "reached_by_all", "median_S_beyond_target",
                                       "median_D", "median_change", "median_edits", "median_evaluated"}))
    all.push_back(column);
  Table& table = report.table("alpha", all);
  const auto trials = by_alpha(models);
  const std::set<Target> common = always_reached(trials);
  for (const auto& [alpha, of_alpha] : trials) {
    std::array<std::vector<double>, 5> values;
    std::int64_t reached = 0;
    for (const auto& [target, trial] : of_alpha) {
      reached += trial.reached ? 1 : 0;
      if (!common.contains(target)) continue;
      const Measures& best = *trial.best;
      values[0].push_back(best.stackability - trial.task.target);
      values[1].push_back(distortion(best));
      values[2].push_back(change(best));
      values[3].push_back(static_cast<double>(best.edits));
      values[4].push_back(static_cast<double>(trial.evaluated));
    }
    std::vector<Cell> row = {alpha, static_cast<std::int64_t>(of_alpha.size()), reached,
                             static_cast<std::int64_t>(common.size())};
    for (const std::vector<double>& one : values) row.push_back(one.empty() ? Cell() : Cell(median(one)));
    table.add(std::move(row));
  }
}

/// Cost over S of every variant: lines of the refined preset that begin at rest, and the paper's steps as
/// marks of the same colour.
Plot curves_of(const Findings& findings, Cost cost, const std::string& title) {
  Plot plot{findings.model, {"S reached"}, {title}, {}};
  int colour = 0;
  for (const Variant& variant : variants()) {
    Series line{variant.name, {{findings.stackability_at_rest, 0}}, SeriesStyle::line, colour};
    Series marks{"", {}, SeriesStyle::dots, colour++};
    for (const Trial& trial : findings.trials) {
      if (trial.variant != variant.name || !trial.reached) continue;
      Series& series = trial.task.preset == ImprovementPreset::refined ? line : marks;
      series.points.emplace_back(trial.best->stackability, cost(*trial.best));
    }
    if (line.points.size() > 1) plot.series.push_back(std::move(line));
    if (!marks.points.empty()) plot.series.push_back(std::move(marks));
  }
  return plot;
}

using AlphaMeasure = double (*)(const Trial&);

/// One line per model, at the target whose designs are shown.
Plot alpha_plot(const std::vector<Findings>& models, const LabelledAxis& axis, AlphaMeasure measure) {
  Plot plot{"mixed controllers in the paper's steps", {"alpha"}, axis, {}};
  const auto trials = by_alpha(models);
  int colour = 0;
  for (const Findings& findings : models) {
    Series series{findings.model, {}, SeriesStyle::line, colour++ % plot_colours};
    for (const auto& [alpha, of_alpha] : trials) {
      const auto found = of_alpha.find({findings.model, findings.shown_fraction});
      if (found != of_alpha.end() && found->second.reached)
        series.points.emplace_back(alpha, measure(found->second));
    }
    if (!series.points.empty()) plot.series.push_back(std::move(series));
  }
  return plot;
}

}  // namespace

void summarise(const std::vector<Findings>& models, Report& report) {
  if (models.empty()) return;
  add_summary(models, report);
  add_alphas(models, report);
  std::vector<Plot> curves;
  for (const Findings& findings : models) {
    curves.push_back(curves_of(findings, distortion, "D"));
    curves.push_back(curves_of(findings, change, "change, RMS over the diagonal"));
  }
  report.plots("", std::move(curves));
  report.plots("alpha",
               {alpha_plot(models, {"D"}, [](const Trial& trial) { return distortion(*trial.best); }),
                alpha_plot(models, {"designs measured", true},
                           [](const Trial& trial) { return static_cast<double>(trial.evaluated); })});
}

}  // namespace stackabilization::experiments
