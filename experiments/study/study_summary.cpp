#include "study/study_summary.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "common/statistics.h"

namespace stackabilization::experiments {

namespace {

using Runs = std::vector<const StudyRun*>;

/// The part of the way from S at rest to the target.
double way(const StudyRun& run) {
  return (run.stackability - run.before) / (run.target - run.before);
}

/// Did the first one do better: the target rather than not, then the less of `cost`, or more S where both
/// missed?
template <class Cost>
bool better(const StudyRun& a, const StudyRun& b, const Cost& cost) {
  if (a.reached != b.reached) return a.reached;
  return a.reached ? cost(a) < cost(b) : a.stackability > b.stackability;
}

template <class Member>
std::vector<double> each(const Runs& runs, const Member& member) {
  std::vector<double> values;
  for (const StudyRun* run : runs) values.push_back(static_cast<double>(member(*run)));
  return values;
}

template <class Condition>
double share(const Runs& runs, const Condition& holds) {
  const auto count =
      std::count_if(runs.begin(), runs.end(), [&](const StudyRun* run) { return holds(*run); });
  return static_cast<double>(count) / static_cast<double>(runs.size());
}

double distortion(const StudyRun& run) {
  return run.energy.distortion.total();
}

double change(const StudyRun& run) {
  return run.change;
}

/// Lower quartile, median, upper quartile.
void add_quartiles(const std::vector<double>& values, std::vector<Cell>& row) {
  for (const double fraction : {0.25, 0.5, 0.75})
    row.emplace_back(values.empty() ? Cell() : Cell(quantile(values, fraction)));
}

/// Users and tasks in the order in which they occur.
template <class Member>
std::vector<std::string> names(const std::vector<StudyRun>& runs, const Member& member) {
  std::vector<std::string> all;
  for (const StudyRun& run : runs)
    if (std::find(all.begin(), all.end(), member(run)) == all.end()) all.push_back(member(run));
  return all;
}

class Summary {
 public:
  Summary(const std::vector<StudyRun>& runs, Report& report) : runs_(runs), report_(report) {
    for (const StudyRun& run : runs)
      if (run.user == refined_user) refined_[run.task] = &run;
  }

  void add_rows() {
    const auto tasks = names(runs_, [](const StudyRun& run) { return run.task; });
    for (const std::string& task : tasks)
      for (const std::string& user : users())
        add_row(task, user,
                chosen([&](const StudyRun& run) { return run.task == task && run.user == user; }));
    for (const std::string& user : users())
      add_row("all", user, chosen([&](const StudyRun& run) { return run.user == user; }));
  }

  /// Each run a dot; on the left what missed the target, on the right what reached it. The automatic method
  /// lies on top.
  void add_plot_of_distortion() {
    Plot plot{"Distortion against what was reached",
              {"S gained, as a part of what was asked for"},
              {"distortion D", true},
              {}};
    const auto [least, most] = range_of_distortion();
    plot.series.push_back({"", {{1, least}, {1, most}}, SeriesStyle::reference, 7});
    for (const bool simulated : {true, false})
      for (const std::string& user : users()) {
        Series series{user, {}, SeriesStyle::dots, colour(user)};
        for (const StudyRun& run : runs_)
          if (run.user == user && run.seed.has_value() == simulated)
            series.points.emplace_back(way(run), distortion(run));
        if (!series.points.empty()) plot.series.push_back(std::move(series));
      }
    report_.plot("", plot);
  }

  /// Of simulated users, over all tasks.
  void add_plot_of_edits() {
    Plot plot{"Targets reached within so many edits tried", {"edits tried"}, {"share of the targets"}, {}};
    for (const std::string& user : users()) {
      const Runs runs = chosen([&](const StudyRun& run) { return run.user == user && run.seed; });
      if (runs.empty()) continue;
      Series series{user, {{0, 0}}, SeriesStyle::line, colour(user)};
      const double most = quantile(each(runs, [](const StudyRun& run) { return run.tried; }), 1);
      constexpr int places = 20;
      for (int k = 1; k <= places; ++k) {
        const double edits = most * k / places;
        series.points.emplace_back(edits, share(runs, [&](const StudyRun& run) {
                                     return run.reached && static_cast<double>(run.tried) <= edits;
                                   }));
      }
      plot.series.push_back(std::move(series));
    }
    report_.plot("edits", plot);
  }

 private:
  std::vector<std::string> users() const {
    return names(runs_, [](const StudyRun& run) { return run.user; });
  }

  template <class Condition>
  Runs chosen(const Condition& condition) const {
    Runs result;
    for (const StudyRun& run : runs_)
      if (condition(run)) result.push_back(&run);
    return result;
  }

  int colour(const std::string& user) const {
    const std::vector<std::string> all = users();
    return static_cast<int>(std::find(all.begin(), all.end(), user) - all.begin()) % 7;
  }

  /// Least and largest D that a logarithmic axis can show.
  std::pair<double, double> range_of_distortion() const {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const StudyRun& run : runs_) {
      if (distortion(run) <= 0) continue;
      least = std::min(least, distortion(run));
      most = std::max(most, distortion(run));
    }
    return {least, most};
  }

  Table& table() const {
    std::vector<Column> all = columns({"task", "user"}, ColumnKind::key);
    const std::vector<std::string> values = {"runs",
                                             "reached",
                                             "S_lower",
                                             "S_median",
                                             "S_upper",
                                             "way_lower",
                                             "way_median",
                                             "way_upper",
                                             "D_lower",
                                             "D_median",
                                             "D_upper",
                                             "D_median_where_reached",
                                             "change_rms_median",
                                             "kept_lower",
                                             "kept_median",
                                             "kept_upper",
                                             "tried_lower",
                                             "tried_median",
                                             "tried_upper",
                                             "refined_beats_D",
                                             "refined_beats_change_rms"};
    for (const Column& column : columns(values)) all.push_back(column);
    all.push_back({"median_cpu_seconds", ColumnKind::clock});
    return report_.table("summary", all);
  }

  void add_row(const std::string& task, const std::string& user, const Runs& runs) {
    if (runs.empty()) return;
    std::vector<Cell> row = {task, user, static_cast<std::int64_t>(runs.size()),
                             share(runs, [](const StudyRun& run) { return run.reached; })};
    const bool one_target = task != "all";
    add_quartiles(
        one_target ? each(runs, [](const StudyRun& run) { return run.stackability; }) : std::vector<double>{},
        row);
    add_quartiles(each(runs, way), row);
    add_quartiles(each(runs, distortion), row);
    Runs reached = runs;
    std::erase_if(reached, [](const StudyRun* run) { return !run->reached; });
    row.emplace_back(reached.empty() ? Cell() : Cell(median(each(reached, distortion))));
    row.emplace_back(median(each(runs, change)));
    add_quartiles(each(runs, [](const StudyRun& run) { return run.kept; }), row);
    add_quartiles(each(runs, [](const StudyRun& run) { return run.tried; }), row);
    row.emplace_back(share_beaten(runs, distortion));
    row.emplace_back(share_beaten(runs, change));
    row.emplace_back(median(each(runs, [](const StudyRun& run) { return run.processor_seconds; })));
    table().add(std::move(row));
  }

  template <class Cost>
  double share_beaten(const Runs& runs, const Cost& cost) const {
    return share(runs, [&](const StudyRun& run) { return better(*refined_.at(run.task), run, cost); });
  }

  const std::vector<StudyRun>& runs_;
  Report& report_;
  std::map<std::string, const StudyRun*> refined_;  ///< by task
};

void add_run(const StudyRun& run, Table& table) {
  const Distortion& d = run.energy.distortion;
  table.add({run.task, run.model, run.input_hash, run.user, run.seed ? Cell(*run.seed) : Cell(), run.target,
             run.before, run.reached, run.stackability, d.total(), d.volume, d.proximity, d.box, d.symmetry,
             run.energy.value, run.change, run.kept, run.tried, run.processor_seconds});
}

}  // namespace

void report_study(const std::vector<StudyRun>& runs, Report& report) {
  std::vector<Column> all = columns({"task", "model", "input_hash", "user", "seed"}, ColumnKind::key);
  for (const Column& column : columns({"target", "S_before", "reached", "S", "D", "D_vol", "D_prox", "D_BB",
                                       "D_symm", "E", "change_rms", "edits_kept", "edits_tried"}))
    all.push_back(column);
  all.push_back({"cpu_seconds", ColumnKind::clock});
  Table& table = report.table("", all);
  for (const StudyRun& run : runs) add_run(run, table);
  if (runs.empty()) return;
  Summary summary(runs, report);
  summary.add_rows();
  summary.add_plot_of_distortion();
  summary.add_plot_of_edits();
}

}  // namespace stackabilization::experiments
