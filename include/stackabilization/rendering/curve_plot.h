#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/core/shape.h"
#include "stackabilization/rendering/drawing.h"

namespace stackabilization {

/// Mark of data points. Marks differ in shape, so that series are distinguishable without colours.
enum class PlotMark { none, circle, square, diamond, triangle };

/// Line of a series.
enum class PlotLine {
  none,       ///< marks only
  thin,       ///< thin line, for a reference beside the data
  solid,      ///< line of the data
  over_area,  ///< line of the data, with a tinted area down to the lower end of the y axis
};

/// Data of one kind, in their order.
struct PlotSeries {
  std::string name;              ///< name in the legend; may be empty
  Colour colour = palette::ink;  ///< colour of line and marks
  /// Data in order. A point that is not finite, or outside the axes, interrupts the line.
  std::vector<Eigen::Vector2d> points;
  PlotLine line = PlotLine::solid;  ///< line between consecutive points
  PlotMark mark = PlotMark::none;   ///< mark at every point
};

/// Scale of an axis.
enum class AxisScale { linear, logarithmic };

/// One axis of a plot.
struct PlotAxis {
  std::string title;                    ///< quantity and unit
  std::optional<Range> range;           ///< low < high, data units; default: round values around the data
  AxisScale scale = AxisScale::linear;  ///< a logarithmic axis requires positive data
};

/// A text at a position of the data.
struct PlotNote {
  Eigen::Vector2d at;            ///< data units
  std::string text;              ///< one line, UTF-8
  Colour colour = palette::ink;  ///< colour of the text
  Anchor anchor = Anchor::left;  ///< end of the text at the position
};

/// Curves over two axes.
struct CurvePlot {
  PlotAxis x, y;                   ///< horizontal and vertical axis
  std::vector<PlotSeries> series;  ///< later series cover earlier ones
  std::vector<PlotNote> notes;     ///< drawn over all series
};

/// Map from data to pixels of a drawing.
class PlotArea {
 public:
  /// Lays out the axes of `plot` in `place`, with text of `text_size` pixels beside them. Throws UsageError
  /// when a range is empty or not finite, when there are no data to determine one, or when data on a
  /// logarithmic axis are not positive.
  PlotArea(const CurvePlot& plot, const Rectangle& place, double text_size);

  const Rectangle& rectangle() const { return rectangle_; }  ///< area between the axes, pixels
  const Range& x() const { return x_; }                      ///< range of the x axis, data units
  const Range& y() const { return y_; }                      ///< range of the y axis, data units

  /// Returns the position of a data point, pixels.
  Eigen::Vector2d at(const Eigen::Vector2d& point) const;
  /// Returns whether a data point is within both axes.
  bool holds(const Eigen::Vector2d& point) const;

 private:
  Rectangle rectangle_;
  Range x_, y_;
  AxisScale x_scale_, y_scale_;
};

/// Draws axes with round ticks and a faint grid, the series over them, the notes over the series, and a
/// legend above when series have names. Throws as PlotArea does.
std::vector<DrawingElement> plot_elements(const CurvePlot& plot, const Rectangle& place, double text_size);

/// Size and heading of a `curve_plot`.
struct CurvePlotOptions {
  int width = 1000, height = 640;  ///< pixels
  std::string title;               ///< heading; may be empty
};

/// Returns a plot as a picture of its own. Needs no OpenGL.
Drawing curve_plot(const CurvePlot& plot, const CurvePlotOptions& options = {});

}  // namespace stackabilization
