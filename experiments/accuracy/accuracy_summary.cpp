#include "accuracy/accuracy_summary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "common/statistics.h"

namespace stackabilization::experiments {
namespace {

/// Below it, the depth buffer of the OpenGL raster rules the error.
constexpr double precision_floor = 0x1p-22;

using Rows = std::vector<const Accuracy*>;

/// Rows of one method by samples a side.
using BySamples = std::map<int, Rows>;
using ByMethod = std::map<std::string, BySamples>;

ByMethod grouped(const std::vector<AccuracyOfModel>& models) {
  ByMethod groups;
  for (const AccuracyOfModel& model : models)
    for (const Accuracy& row : model.rows) groups[row.sampling.method][row.sampling.samples].push_back(&row);
  return groups;
}

std::vector<double> errors(const Rows& rows) {
  std::vector<double> result;
  for (const Accuracy* row : rows) result.push_back(std::abs(row->error));
  return result;
}

/// Through the medians of the samplings that saw every direction.
std::optional<double> order(const BySamples& by_samples) {
  std::size_t most = 0;
  for (const auto& [samples, rows] : by_samples) most = std::max(most, rows.size());
  std::vector<Eigen::Vector2d> medians;
  for (const auto& [samples, rows] : by_samples)
    if (rows.size() == most) medians.emplace_back(samples, median(errors(rows)));
  return order_of_convergence(medians, precision_floor);
}

Cell cell(const std::optional<double>& value) {
  return value ? Cell(*value) : Cell();
}

void add_summary(const std::string& model, const std::string& hash, const ByMethod& groups, Table& table) {
  for (const auto& [method, by_samples] : groups)
    for (const auto& [samples, rows] : by_samples) {
      const std::vector<double> all = errors(rows);
      std::vector<double> S_errors, across, milliseconds;
      for (const Accuracy* row : rows) {
        S_errors.push_back(std::abs(row->S_error));
        across.push_back(row->sampling.across);
        milliseconds.push_back(1e3 * row->sampling.processor_seconds);
      }
      const Accuracy& worst =
          *rows[static_cast<std::size_t>(std::max_element(all.begin(), all.end()) - all.begin())];
      table.add({model, hash, method, std::int64_t{samples}, static_cast<std::int64_t>(rows.size()),
                 median(across), median(all), quantile(all, 0.9), quantile(all, 1), median(S_errors),
                 quantile(S_errors, 1), cell(order(by_samples)), worst.direction.x(), worst.direction.y(),
                 worst.direction.z(), worst.error, worst.shortfall.reason, cell(worst.shortfall.width),
                 median(milliseconds)});
    }
}

Table& summary_table(const std::string& name, Report& report) {
  std::vector<Column> all = columns({"model", "input_hash", "method", "samples"}, ColumnKind::key);
  for (const Column& column :
       columns({"directions", "median_across", "median_error", "error_of_90_percent", "largest_error",
                "median_S_error", "largest_S_error", "order", "worst_x", "worst_y", "worst_z", "worst_error",
                "worst_reason", "missed_width_pixels"}))
    all.push_back(column);
  all.push_back({"median_cpu_ms", ColumnKind::clock});
  return report.table(name, all);
}

/// How often each reason is behind an error of more than a thousandth.
void add_reasons(const ByMethod& groups, Report& report) {
  constexpr double notable = 1e-3;
  Table& table = report.table("reasons", {{"method", ColumnKind::key},
                                          {"samples", ColumnKind::key},
                                          {"reason", ColumnKind::key},
                                          {"cases"},
                                          {"share"},
                                          {"median_error"}});
  for (const auto& [method, by_samples] : groups)
    for (const auto& [samples, rows] : by_samples) {
      std::map<std::string, std::vector<double>> by_reason;
      for (const Accuracy* row : rows)
        if (std::abs(row->error) > notable) by_reason[row->shortfall.reason].push_back(std::abs(row->error));
      for (const auto& [reason, found] : by_reason)
        table.add({method, std::int64_t{samples}, reason, static_cast<std::int64_t>(found.size()),
                   static_cast<double>(found.size()) / static_cast<double>(rows.size()), median(found)});
    }
}

/// The fewest samples with which, and with more, the error of a share of the cases keeps below a bound.
void add_needed(const ByMethod& groups, Report& report) {
  Table& table = report.table("needed", {{"method", ColumnKind::key},
                                         {"error_over_height", ColumnKind::key},
                                         {"share_of_cases", ColumnKind::key},
                                         {"samples_needed"},
                                         {"directions_there"},
                                         {"largest_tried"}});
  for (const auto& [method, by_samples] : groups) {
    if (method == authors_method) continue;
    for (const double bound : {0.1, 0.01, 0.001, 0.0001})
      for (const double share : {0.5, 0.9, 1.0}) {
        Cell needed, directions;
        for (auto it = by_samples.rbegin(); it != by_samples.rend(); ++it) {
          if (quantile(errors(it->second), share) > bound) break;
          needed = std::int64_t{it->first};
          directions = static_cast<std::int64_t>(it->second.size());
        }
        table.add({method, bound, share, needed, directions, std::int64_t{by_samples.rbegin()->first}});
      }
  }
}

const LabelledAxis samples_axis{"samples across the shape", true};

double middle_across(const Rows& rows) {
  std::vector<double> across;
  for (const Accuracy* row : rows) across.push_back(row->sampling.across);
  return median(across);
}

/// One figure of each sampling of a method against the samples across the shape.
template <class Figure>
Series series_of(const std::string& name, const BySamples& by_samples, int colour, const Figure& figure) {
  Series series{name, {}, by_samples.size() > 1 ? SeriesStyle::line : SeriesStyle::dots, colour};
  for (const auto& [samples, rows] : by_samples)
    series.points.emplace_back(middle_across(rows), figure(rows));
  return series;
}

struct Share {
  const char* name;
  int colour;
  double share;
};
constexpr std::array<Share, 3> shares{{{"worst case", 1, 1}, {"nine of ten", 3, 0.9}, {"median", 0, 0.5}}};

/// The errors of rays and of the OpenGL raster are those of the CPU raster, to rounding and depth.
void plot_errors(const ByMethod& groups, Report& report) {
  Plot plot{"How wrong is a sampled minimal translation?", samples_axis, {"error of f_max / h", true}, {}};
  if (const auto group = groups.find("CPU raster"); group != groups.end())
    for (const auto& [name, colour, share] : shares)
      plot.series.push_back(series_of(name, group->second, colour, [&, part = share](const Rows& rows) {
        return quantile(errors(rows), part);
      }));
  if (const auto group = groups.find(authors_method); group != groups.end()) {
    Series theirs{"the same, authors' framing", {}, SeriesStyle::dots, 6};
    const Rows& rows = group->second.begin()->second;
    for (const auto& [name, colour, share] : shares)
      theirs.points.emplace_back(middle_across(rows), quantile(errors(rows), share));
    plot.series.push_back(std::move(theirs));
  }
  if (const auto cpu = groups.find("CPU raster"); cpu != groups.end() && cpu->second.contains(64)) {
    const double at_64 = median(errors(cpu->second.at(64)));
    plot.series.push_back({"order 1", {{32, 2 * at_64}, {4096, at_64 / 64}}, SeriesStyle::reference, 7});
  }
  report.plot("", plot);
}

void plot_times(const ByMethod& groups, Report& report) {
  Plot plot{"What does a sampled minimal translation cost?",
            samples_axis,
            {"processor milliseconds per direction", true},
            {}};
  for (const auto& [method, by_samples] : groups)
    plot.series.push_back(
        series_of(method, by_samples, static_cast<int>(plot.series.size()), [](const Rows& rows) {
          std::vector<double> milliseconds;
          for (const Accuracy* row : rows) milliseconds.push_back(1e3 * row->sampling.processor_seconds);
          return median(milliseconds);
        }));
  report.plot("time", plot);
}

}  // namespace

void summarise(const std::vector<AccuracyOfModel>& models, Report& report) {
  for (const AccuracyOfModel& model : models)
    add_summary(model.model, model.hash, grouped({model}), summary_table("models", report));
  const ByMethod all = grouped(models);
  add_summary("all", "", all, summary_table("summary", report));
  add_reasons(all, report);
  add_needed(all, report);
  plot_errors(all, report);
  plot_times(all, report);
}

}  // namespace stackabilization::experiments
