#include "stackabilization/rendering/curve_plot.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "rendering/drawing/legend.h"
#include "rendering/drawing/plot_parts.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {
namespace {

using detail::Elements;

constexpr int tick_count = 6;
constexpr double legend_height = 1.9;  ///< em

const PlotAxis& axis_of(const CurvePlot& plot, int coordinate) {
  return coordinate == 0 ? plot.x : plot.y;
}

Range data_range(const CurvePlot& plot, int coordinate) {
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const PlotSeries& series : plot.series)
    for (const Eigen::Vector2d& point : series.points)
      if (point.allFinite()) {
        range.low = std::min(range.low, point[coordinate]);
        range.high = std::max(range.high, point[coordinate]);
      }
  if (!(range.low <= range.high))
    throw UsageError("a plot needs at least one point, or the ranges of both axes");
  return range;
}

Range round_outwards(const Range& data) {
  const double width = data.length() > 0 ? data.length() : std::max(std::abs(data.low), 1.0);
  const Range wide = data.length() > 0 ? data : Range{data.low - width / 2, data.high + width / 2};
  const std::vector<double> values = detail::ticks(wide.low, wide.high, tick_count);
  if (values.size() < 2) return wide;
  const double step = values[1] - values[0];
  return {std::floor(wide.low / step) * step, std::ceil(wide.high / step) * step};
}

Range whole_powers(const Range& data) {
  const double low = std::floor(std::log10(data.low));
  return {std::pow(10, low), std::pow(10, std::max(low + 1, std::ceil(std::log10(data.high))))};
}

Range range_of(const CurvePlot& plot, int coordinate) {
  const PlotAxis& axis = axis_of(plot, coordinate);
  const bool logarithmic = axis.scale == AxisScale::logarithmic;
  const Range range = axis.range ? *axis.range : data_range(plot, coordinate);
  if (logarithmic && !(range.low > 0)) throw UsageError("a logarithmic axis needs positive values");
  if (!axis.range) return logarithmic ? whole_powers(range) : round_outwards(range);
  if (!std::isfinite(range.low) || !std::isfinite(range.high) || !(range.low < range.high))
    throw UsageError("the range of an axis needs two finite numbers, the smaller one first");
  return range;
}

std::vector<double> ticks_of(const Range& range, AxisScale scale, int count = tick_count) {
  if (scale == AxisScale::linear) return detail::ticks(range.low, range.high, count);
  std::vector<double> powers;
  const int last = static_cast<int>(std::floor(std::log10(range.high)));
  for (int e = static_cast<int>(std::ceil(std::log10(range.low))); e <= last; ++e)
    powers.push_back(std::pow(10, e));
  return powers;
}

/// 0 at the low end, 1 at the high end.
double fraction(double value, const Range& range, AxisScale scale) {
  if (scale == AxisScale::linear) return (value - range.low) / range.length();
  return std::log10(value / range.low) / std::log10(range.high / range.low);
}

std::vector<LegendEntry> legend_entries(const CurvePlot& plot) {
  std::vector<LegendEntry> entries;
  for (const PlotSeries& series : plot.series)
    if (!series.name.empty())
      entries.push_back(
          {series.line == PlotLine::none ? LegendMark::dot : LegendMark::line, series.colour, series.name});
  return entries;
}

/// Widest label at the y axis, pixels.
double label_width(const Range& range, AxisScale scale, double text_size) {
  double width = 0;
  for (const double value : ticks_of(range, scale))
    width = std::max(width, text_width({{0, 0}, detail::number_text(value), text_size}));
  return width;
}

/// Ticks of the x axis, few enough that their labels stay apart.
std::vector<double> spaced_ticks(const Range& range, AxisScale scale, double width, double text_size) {
  constexpr double air = 0.8;  // em
  for (int count = tick_count; count > 1; --count) {
    const std::vector<double> values = ticks_of(range, scale, count);
    const double room = values.size() < 2
                            ? width
                            : width * (fraction(values[1], range, scale) - fraction(values[0], range, scale));
    if (label_width(range, scale, text_size) + air * text_size <= room) return values;
  }
  return ticks_of(range, scale, 1);
}

class Plotter {
 public:
  Plotter(const CurvePlot& plot, const Rectangle& place, double text_size)
      : plot_(plot), place_(place), size_(text_size), area_(plot, place, text_size) {}

  Elements elements();

 private:
  void add_grid();
  void add_titles();
  void add_series(const PlotSeries& series);
  void add_run(const PlotSeries& series, const std::vector<Eigen::Vector2d>& run);
  void add_mark(const PlotSeries& series, const Eigen::Vector2d& at);

  const CurvePlot& plot_;
  Rectangle place_;
  double size_;
  PlotArea area_;
  Elements elements_;
};

void Plotter::add_grid() {
  const Colour faint = mix(palette::white, palette::faint, 0.25);
  const Rectangle& area = area_.rectangle();
  for (const double value : spaced_ticks(area_.x(), plot_.x.scale, area.width, size_)) {
    const double x = area_.at({value, area_.y().low}).x();
    elements_.emplace_back(Polyline{detail::segment(x, area.y, x, area.bottom()), faint, 1});
    elements_.emplace_back(Text{
        {x, area.bottom() + 1.15 * size_}, detail::number_text(value), size_, palette::ink, Anchor::centre});
  }
  for (const double value : ticks_of(area_.y(), plot_.y.scale)) {
    const double y = area_.at({area_.x().low, value}).y();
    elements_.emplace_back(Polyline{detail::segment(area.x, y, area.right(), y), faint, 1});
    elements_.emplace_back(Text{{area.x - 0.4 * size_, y + 0.35 * size_},
                                detail::number_text(value),
                                size_,
                                palette::ink,
                                Anchor::right});
  }
  PlanePoints corner(3, 2);
  corner << area.x, area.y, area.x, area.bottom(), area.right(), area.bottom();
  elements_.emplace_back(Polyline{corner, palette::ink, 1.5});
}

void Plotter::add_titles() {
  const Rectangle& area = area_.rectangle();
  elements_.emplace_back(detail::fitted({{area.x + area.width / 2, area.bottom() + 2.5 * size_},
                                         plot_.x.title,
                                         size_,
                                         palette::ink,
                                         Anchor::centre},
                                        place_.width));
  elements_.emplace_back(Text{{place_.x + 0.9 * size_, area.y + area.height / 2},
                              plot_.y.title,
                              size_,
                              palette::ink,
                              Anchor::centre,
                              false,
                              true});
}

void Plotter::add_mark(const PlotSeries& series, const Eigen::Vector2d& at) {
  const double r = 0.3 * size_;
  PlanePoints points(4, 2);
  switch (series.mark) {
    case PlotMark::none:
      return;
    case PlotMark::circle:
      points = detail::circle(at, 0.9 * r);
      break;
    case PlotMark::square:
      points << -r, -r, r, -r, r, r, -r, r;
      points = 0.85 * points;
      points.rowwise() += at.transpose();
      break;
    case PlotMark::diamond:
      points << -r, 0, 0, -r, r, 0, 0, r;
      points = 1.15 * points;
      points.rowwise() += at.transpose();
      break;
    case PlotMark::triangle:
      points.resize(3, 2);
      points << 0, -1.1 * r, r, 0.8 * r, -r, 0.8 * r;
      points.rowwise() += at.transpose();
      break;
  }
  elements_.emplace_back(FilledPolygon{std::move(points), series.colour});
}

/// A stretch of a series without a break, pixels.
void Plotter::add_run(const PlotSeries& series, const std::vector<Eigen::Vector2d>& run) {
  constexpr double tint = 0.72;
  const auto count = static_cast<Eigen::Index>(run.size());
  PlanePoints line(count, 2);
  for (Eigen::Index i = 0; i < count; ++i) line.row(i) = run[static_cast<std::size_t>(i)].transpose();
  if (series.line == PlotLine::over_area && count > 1) {
    PlanePoints area(count + 2, 2);
    area.topRows(count) = line;
    area.row(count) << run.back().x(), area_.rectangle().bottom();
    area.row(count + 1) << run.front().x(), area_.rectangle().bottom();
    elements_.emplace_back(FilledPolygon{std::move(area), mix(series.colour, palette::white, tint)});
  }
  if (series.line != PlotLine::none && count > 1)
    elements_.emplace_back(
        Polyline{std::move(line), series.colour, series.line == PlotLine::thin ? 1.5 : 0.12 * size_});
}

void Plotter::add_series(const PlotSeries& series) {
  std::vector<Eigen::Vector2d> run;
  for (const Eigen::Vector2d& point : series.points) {
    if (area_.holds(point)) {
      run.push_back(area_.at(point));
      continue;
    }
    add_run(series, run);
    run.clear();
  }
  add_run(series, run);
  for (const Eigen::Vector2d& point : series.points)
    if (area_.holds(point)) add_mark(series, area_.at(point));
}

Elements Plotter::elements() {
  add_grid();
  for (const PlotSeries& series : plot_.series) add_series(series);
  add_titles();
  for (const PlotNote& note : plot_.notes)
    elements_.emplace_back(Text{area_.at(note.at), note.text, size_, note.colour, note.anchor, true});
  const Rectangle& area = area_.rectangle();
  for (DrawingElement& entry :
       detail::legend(legend_entries(plot_), {area.x, place_.y, area.width, area.y - place_.y}, size_))
    elements_.push_back(std::move(entry));
  return std::move(elements_);
}

}  // namespace

PlotArea::PlotArea(const CurvePlot& plot, const Rectangle& place, double text_size)
    : x_(range_of(plot, 0)), y_(range_of(plot, 1)), x_scale_(plot.x.scale), y_scale_(plot.y.scale) {
  const double left = 0.9 * text_size + label_width(y_, y_scale_, text_size) + 0.9 * text_size;
  const double right = 0.9 * text_size;
  const double bottom = (plot.x.title.empty() ? 1.8 : 3.0) * text_size;
  const double top = legend_entries(plot).empty() ? 0.8 * text_size : legend_height * text_size;
  rectangle_ = {place.x + left, place.y + top, std::max(1.0, place.width - left - right),
                std::max(1.0, place.height - top - bottom)};
}

Eigen::Vector2d PlotArea::at(const Eigen::Vector2d& point) const {
  return {rectangle_.x + fraction(point.x(), x_, x_scale_) * rectangle_.width,
          rectangle_.bottom() - fraction(point.y(), y_, y_scale_) * rectangle_.height};
}

bool PlotArea::holds(const Eigen::Vector2d& point) const {
  return point.allFinite() && point.x() >= x_.low && point.x() <= x_.high && point.y() >= y_.low &&
         point.y() <= y_.high;
}

std::vector<DrawingElement> plot_elements(const CurvePlot& plot, const Rectangle& place, double text_size) {
  return Plotter(plot, place, text_size).elements();
}

Drawing curve_plot(const CurvePlot& plot, const CurvePlotOptions& options) {
  const double size = options.width / 48.0, margin = 1.2 * size;
  Drawing drawing{options.width, options.height, {}};
  const detail::Heading heading = detail::heading(options.title, {}, options.width, size);
  drawing.add(heading.elements);
  const double top = heading.bottom + 0.6 * size;
  drawing.add(
      plot_elements(plot, {margin, top, options.width - 2 * margin, options.height - top - margin}, size));
  return drawing;
}

}  // namespace stackabilization
