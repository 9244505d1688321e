#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/core/shape.h"
#include "stackabilization/rendering/drawing.h"

namespace stackabilization {

/// How data are marked. Marks differ in shape so that series can be told apart without colours.
enum class PlotMark { none, circle, square, diamond, triangle };

/// How a series is joined up.
enum class PlotLine {
  none,       ///< marks only
  thin,       ///< a reference beside the data
  solid,      ///< the data
  over_area,  ///< with the area between it and the lower end of the y axis tinted
};

/// Data of one kind, in their order.
struct PlotSeries {
  std::string name;                     ///< in the legend; may be empty
  Colour colour = palette::ink;         ///< of line and marks
  std::vector<Eigen::Vector2d> points;  ///< a point that is not finite, or off the axes, breaks the line
  PlotLine line = PlotLine::solid;      ///< between neighbours
  PlotMark mark = PlotMark::none;       ///< at every point
};

/// How values are spread along an axis.
enum class AxisScale { linear, logarithmic };

/// One axis of a plot.
struct PlotAxis {
  std::string title;                    ///< what is measured, and its unit
  std::optional<Range> range;           ///< low < high, data units; default: round values around the data
  AxisScale scale = AxisScale::linear;  ///< logarithmic: positive data only
};

/// Words at a place of the data.
struct PlotNote {
  Eigen::Vector2d at;            ///< data units
  std::string text;              ///< one line, UTF-8
  Colour colour = palette::ink;  ///< of the letters
  Anchor anchor = Anchor::left;  ///< which end of the text is at the place
};

/// Curves over two axes.
struct CurvePlot {
  PlotAxis x, y;                   ///< to the right, and upwards
  std::vector<PlotSeries> series;  ///< later ones over earlier ones
  std::vector<PlotNote> notes;     ///< over all series
};

/// Where data are in a drawing.
class PlotArea {
 public:
  /// The axes of `plot` drawn into `place`, text of `text_size` pixels beside them. Throws UsageError when a
  /// range is empty or not finite, there are no data to find one, or a logarithmic axis meets what is not
  /// positive.
  PlotArea(const CurvePlot& plot, const Rectangle& place, double text_size);

  const Rectangle& rectangle() const { return rectangle_; }  ///< between the axes, pixels
  const Range& x() const { return x_; }                      ///< data units
  const Range& y() const { return y_; }                      ///< data units

  /// Pixels of a point of the data.
  Eigen::Vector2d at(const Eigen::Vector2d& point) const;
  /// Does the point lie on the axes?
  bool holds(const Eigen::Vector2d& point) const;

 private:
  Rectangle rectangle_;
  Range x_, y_;
  AxisScale x_scale_, y_scale_;
};

/// Axes with round ticks and a faint grid, the series over them, the notes over these, a legend above where
/// series have names. Throws as PlotArea does.
std::vector<DrawingElement> plot_elements(const CurvePlot& plot, const Rectangle& place, double text_size);

/// Size and heading of a `curve_plot`.
struct CurvePlotOptions {
  int width = 1000, height = 640;  ///< pixels
  std::string title;               ///< heading; may be empty
};

/// A plot as a picture of its own. Needs no OpenGL.
Drawing curve_plot(const CurvePlot& plot, const CurvePlotOptions& options = {});

}  // namespace stackabilization
