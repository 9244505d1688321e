#include "common/plot_drawing.h"

#include <array>

#include "stackabilization/rendering/curve_plot.h"
#include "stackabilization/shape/errors.h"

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

PlotSeries drawn(const Plot& plot, const Series& series) {
  const auto colour = static_cast<std::size_t>(series.colour);
  PlotSeries result{series.name, colours.at(colour), shown(plot, series)};
  if (series.style == SeriesStyle::reference) result.line = PlotLine::thin;
  if (series.style == SeriesStyle::dots) result.line = PlotLine::none;
  if (series.style != SeriesStyle::reference) result.mark = marks.at(colour % marks.size());
  return result;
}

}  // namespace

bool has_points(const Plot& plot) {
  for (const Series& series : plot.series)
    if (!shown(plot, series).empty()) return true;
  return false;
}

Drawing drawing_of(const Plot& plot) {
  if (!has_points(plot)) throw UsageError("a plot needs at least one point");
  CurvePlot curves{axis_of(plot.x), axis_of(plot.y), {}, {}};
  for (const Series& series : plot.series) curves.series.push_back(drawn(plot, series));
  CurvePlotOptions options;
  options.title = plot.title;
  return curve_plot(curves, options);
}

}  // namespace stackabilization::experiments
