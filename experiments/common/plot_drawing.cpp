#include "common/plot_drawing.h"

#include <algorithm>
#include <array>

#include "common/statistics.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/rendering/curve_plot.h"

namespace stackabilization::experiments {
namespace {

constexpr std::array<Colour, plot_colours> colours{palette::upper,
                                                   palette::contact,
                                                   palette::output,
                                                   palette::lower,
                                                   Colour{0.48, 0.33, 0.65},
                                                   Colour{0.20, 0.60, 0.62},
                                                   palette::ink,
                                                   palette::faint,
                                                   Colour{0.85, 0.45, 0.65},
                                                   Colour{0.55, 0.38, 0.20},
                                                   Colour{0.70, 0.66, 0.10}};

constexpr std::array<PlotMark, 4> marks{PlotMark::circle, PlotMark::square, PlotMark::diamond,
                                        PlotMark::triangle};

PlotAxis axis_of(const LabelledAxis& axis) {
  return {axis.title, {}, axis.logarithmic ? AxisScale::logarithmic : AxisScale::linear};
}

/// Without what a logarithmic axis cannot show.
std::vector<Eigen::Vector2d> shown(const Plot& plot, const Series& series) {
  std::vector<Eigen::Vector2d> points = series.points;
  std::erase_if(points, [&](const Eigen::Vector2d& p) {
    return !p.allFinite() || (plot.x.logarithmic && p.x() <= 0) || (plot.y.logarithmic && p.y() <= 0);
  });
  return points;
}

/// Without its name, which gets a place of its own.
PlotSeries drawn(const Plot& plot, const Series& series) {
  const auto colour = static_cast<std::size_t>(series.colour);
  PlotSeries result{"", colours.at(colour), shown(plot, series)};
  if (series.style == SeriesStyle::reference) result.line = PlotLine::thin;
  if (series.style == SeriesStyle::dots) result.line = PlotLine::none;
  if (series.style != SeriesStyle::reference) result.mark = marks.at(colour % marks.size());
  return result;
}

constexpr int plot_width = 1000, plot_height = 600;
/// Pixels; in a picture of several plots, which is shown smaller, the other one.
constexpr double text_size = 15, small_plot_text_size = 24;

/// Where a plot goes.
struct Layout {
  Eigen::Vector2d corner;  ///< upper left, pixels
  double text_size;
};

/// The name of a series, beside the axes.
struct Label {
  double y;
  std::string text;
  Colour colour;
};

/// Level with the last point of a line, or with the middle one of the dots.
std::vector<Label> labels_of(const Plot& plot, const PlotArea& area) {
  std::vector<Label> labels;
  for (const Series& series : plot.series) {
    std::vector<double> heights;
    for (const Eigen::Vector2d& point : shown(plot, series)) heights.push_back(area.at(point).y());
    if (series.name.empty() || heights.empty()) continue;
    const bool dots = series.style == SeriesStyle::dots;
    labels.push_back({dots ? median(heights) : heights.back(), series.name,
                      colours.at(static_cast<std::size_t>(series.colour))});
  }
  return labels;
}

/// Moves labels apart: they keep the order of their heights, and at least this distance.
void spread(std::vector<Label>& labels, double distance, double bottom) {
  std::stable_sort(labels.begin(), labels.end(), [](const Label& a, const Label& b) { return a.y < b.y; });
  for (std::size_t i = 1; i < labels.size(); ++i)
    labels[i].y = std::max(labels[i].y, labels[i - 1].y + distance);
  for (std::size_t i = labels.size(); i-- > 0; bottom -= distance) {
    labels[i].y = std::min(labels[i].y, bottom);
    bottom = labels[i].y;
  }
}

void add_plot(const Plot& plot, const Layout& layout, Drawing& drawing) {
  CurvePlot curves{axis_of(plot.x), axis_of(plot.y), {}, {}};
  for (const Series& series : plot.series) curves.series.push_back(drawn(plot, series));
  const double size = layout.text_size;
  const Rectangle place{layout.corner.x() + 20, layout.corner.y() + 60, 710, 520};
  const PlotArea area(curves, place, size);
  std::vector<Label> labels = labels_of(plot, area);
  spread(labels, 1.3 * size, area.rectangle().bottom());
  drawing.add(Text{{area.rectangle().x, layout.corner.y() + 40},
                   plot.title,
                   1.3 * size,
                   palette::ink,
                   Anchor::left,
                   true});
  drawing.add(plot_elements(curves, place, size));
  for (const Label& label : labels)
    drawing.add(
        Text{{area.rectangle().right() + size, label.y + 0.35 * size}, label.text, size, label.colour});
}

}  // namespace

bool has_points(const Plot& plot) {
  for (const Series& series : plot.series)
    if (!shown(plot, series).empty()) return true;
  return false;
}

Drawing drawing_of(const Plot& plot) {
  if (!has_points(plot)) throw UsageError("a plot needs at least one point");
  Drawing drawing{plot_width, plot_height, {}};
  add_plot(plot, {{0, 0}, text_size}, drawing);
  return drawing;
}

Drawing drawing_of(const std::vector<Plot>& plots) {
  if (std::none_of(plots.begin(), plots.end(), has_points)) throw UsageError("plots need at least one point");
  constexpr std::size_t columns = 2;
  const auto rows = static_cast<int>((plots.size() + columns - 1) / columns);
  Drawing drawing{static_cast<int>(columns) * plot_width, rows * plot_height, {}};
  for (std::size_t k = 0; k < plots.size(); ++k) {
    const Eigen::Vector2d corner(plot_width * static_cast<double>(k % columns),
                                 plot_height * static_cast<double>(k / columns));
    if (has_points(plots[k])) add_plot(plots[k], {corner, small_plot_text_size}, drawing);
  }
  return drawing;
}

}  // namespace stackabilization::experiments
