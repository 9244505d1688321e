#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "stackabilization/rendering/drawing.h"

namespace stackabilization::experiments {

/// Points joined by lines; all coordinates positive.
struct LogSeries {
  std::string name;
  Colour colour;
  std::vector<Eigen::Vector2d> points;
  bool reference = false;  ///< a thin line without marks
};

struct LogPlot {
  std::string title, x_title, y_title;
  std::vector<LogSeries> series;
};

/// Both axes logarithmic, one grid line per power of ten, names at the right ends of the series. Throws
/// UsageError when there is no point, or a coordinate is not positive and finite.
Drawing log_plot(const LogPlot& plot);

}  // namespace stackabilization::experiments
