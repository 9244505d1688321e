#include "common/log_plot.h"

#include <algorithm>
#include <cmath>

#include "stackabilization/shape/errors.h"

namespace stackabilization::experiments {
namespace {

constexpr Rectangle frame{110, 70, 620, 440};
constexpr double text_size = 15, mark_size = 4;

std::string power_text(int exponent) {
  if (exponent >= -3 && exponent <= 3) {
    std::string text = "1";
    for (int i = 0; i < exponent; ++i) text += '0';
    return exponent >= 0 ? text : "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + "1";
  }
  return "1e" + std::to_string(exponent);
}

/// Whole powers of ten around the coordinates of all series.
struct Axis {
  int low, high;

  Axis(const LogPlot& plot, int coordinate) {
    double smallest = INFINITY, largest = 0;
    for (const LogSeries& series : plot.series)
      for (const Eigen::Vector2d& point : series.points) {
        if (!(point[coordinate] > 0) || !std::isfinite(point[coordinate]))
          throw UsageError("a logarithmic plot needs positive coordinates");
        smallest = std::min(smallest, point[coordinate]);
        largest = std::max(largest, point[coordinate]);
      }
    if (largest == 0) throw UsageError("a plot needs at least one point");
    low = static_cast<int>(std::floor(std::log10(smallest)));
    high = std::max(low + 1, static_cast<int>(std::ceil(std::log10(largest))));
  }

  /// 0 at the low end, 1 at the high end.
  double at(double value) const { return (std::log10(value) - low) / (high - low); }
};

PlanePoints polyline(const std::vector<Eigen::Vector2d>& points) {
  PlanePoints result(static_cast<Eigen::Index>(points.size()), 2);
  for (std::size_t i = 0; i < points.size(); ++i)
    result.row(static_cast<Eigen::Index>(i)) = points[i].transpose();
  return result;
}

void add_grid(const Axis& x, const Axis& y, Drawing& drawing) {
  const Colour faint = mix(palette::white, palette::faint, 0.3);
  for (int e = x.low; e <= x.high; ++e) {
    const double at = frame.x + frame.width * (e - x.low) / (x.high - x.low);
    drawing.add(Polyline{polyline({{at, frame.y}, {at, frame.bottom()}}), faint});
    drawing.add(
        Text{{at, frame.bottom() + 1.5 * text_size}, power_text(e), text_size, palette::ink, Anchor::centre});
  }
  for (int e = y.low; e <= y.high; ++e) {
    const double at = frame.bottom() - frame.height * (e - y.low) / (y.high - y.low);
    drawing.add(Polyline{polyline({{frame.x, at}, {frame.right(), at}}), faint});
    drawing.add(Text{{frame.x - 0.5 * text_size, at + 0.35 * text_size},
                     power_text(e),
                     text_size,
                     palette::ink,
                     Anchor::right});
  }
}

void add_series(const LogSeries& series, const Axis& x, const Axis& y, Drawing& drawing) {
  std::vector<Eigen::Vector2d> places;
  for (const Eigen::Vector2d& point : series.points)
    places.emplace_back(frame.x + frame.width * x.at(point.x()),
                        frame.bottom() - frame.height * y.at(point.y()));
  drawing.add(Polyline{polyline(places), series.colour, series.reference ? 1.0 : 2.5});
  for (const Eigen::Vector2d& p : places) {
    if (series.reference) continue;
    const double s = mark_size;
    drawing.add(FilledPolygon{
        polyline({{p.x() - s, p.y()}, {p.x(), p.y() - s}, {p.x() + s, p.y()}, {p.x(), p.y() + s}}),
        series.colour});
  }
  drawing.add(Text{{places.back().x() + text_size, places.back().y() + 0.35 * text_size},
                   series.name,
                   text_size,
                   series.colour});
}

}  // namespace

Drawing log_plot(const LogPlot& plot) {
  const Axis x(plot, 0), y(plot, 1);
  Drawing drawing;
  drawing.width = 1000;
  drawing.height = 600;
  drawing.add(Text{{frame.x, 40}, plot.title, 1.3 * text_size, palette::ink, Anchor::left, true});
  add_grid(x, y, drawing);
  for (const LogSeries& series : plot.series)
    if (!series.points.empty()) add_series(series, x, y, drawing);
  drawing.add(Text{{frame.x + frame.width / 2, frame.bottom() + 3.5 * text_size},
                   plot.x_title,
                   text_size,
                   palette::ink,
                   Anchor::centre});
  drawing.add(Text{
      {40, frame.y + frame.height / 2}, plot.y_title, text_size, palette::ink, Anchor::centre, false, true});
  return drawing;
}

}  // namespace stackabilization::experiments
