#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace stackabilization::experiments {

struct LabelledAxis {
  std::string title;
  bool logarithmic = false;
};

enum class SeriesStyle {
  line,       ///< points joined by lines, with marks
  dots,       ///< marks only
  reference,  ///< a thin line without marks
};

/// How many colours there are; the eighth is for what serves comparison.
inline constexpr int plot_colours = 11;

/// Points that belong together. On a logarithmic axis, those that are not positive are left out.
struct Series {
  std::string name;  ///< stands at the right, level with the last point or the middle dot; may be empty
  std::vector<Eigen::Vector2d> points;
  SeriesStyle style = SeriesStyle::line;
  int colour = 0;  ///< series of one colour belong together; in [0, plot_colours)
};

/// A plot as an experiment states it; it becomes a picture where pictures are built.
struct Plot {
  std::string title;
  LabelledAxis x, y;
  std::vector<Series> series;
};

}  // namespace stackabilization::experiments
