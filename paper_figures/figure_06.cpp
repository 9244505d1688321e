#include <algorithm>
#include <cmath>

#include "paper_figures/before_after.h"
#include "paper_figures/shown.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/gap_scaling.h"
#include "stackabilization/deformation/refine.h"

namespace stackabilization::figures {
namespace {

constexpr Colour original_colour{0.70, 0.70, 0.68};  // grey, as in the paper
constexpr int gap_samples = 600;
/// How nearly the two solutions are to be equally compact, relative: a tolerance of the comparison.
constexpr double compactness_tolerance = 1e-4;

struct Figure06Options {
  DesignTask task;
  Camera camera;
  int copies = 1;
  double max_edge_length = 0;  ///< of the triangles that gap scaling moves, fraction of the diagonal
};

Figure06Options read_figure_06(const Fields& fields) {
  Figure06Options options{read_design_task(fields.object("task")), read_camera(fields), read_copies(fields),
                          fields.number("longest_edge")};
  if (!(options.max_edge_length > 0)) fields.refuse("longest_edge", "a number above 0");
  return options;
}

/// Scales the gap function until a further copy adds as much height to a stack as asked for.
class GapScaling {
 public:
  GapScaling(const Shape& rest, const Figure06Options& options)
      : direction_(*options.task.space.direction),
        measure_(options.task.requirements.measure),
        rest_(refine(rest, {options.max_edge_length})),
        model_(gap_scaling(unstructured(rest_), direction_)) {}

  /// `factor`: what the gap was scaled by in the end.
  MeasuredShape as_compact_as(const Stackability& wanted, double& factor) const {
    constexpr int max_steps = 12;
    MeasuredShape shape = measured_shape(rest_, direction_, measure_);
    for (int k = 0; k < max_steps; ++k) {
      const double ratio = wanted.f_max / shape.measured.f_max;
      if (std::abs(ratio - 1) <= compactness_tolerance) return shape;
      factor *= ratio;
      shape = measured_shape(scaled(factor), direction_, measure_);
    }
    throw InputError("gap scaling does not come to the compactness of the other solution");
  }

 private:
  Shape scaled(double factor) const {
    const Edit edit{{HandleKind::shape, 0, 0}, Scale{factor, direction_.unit()}};
    const DeformationResult result = model_->deformed({edit});
    if (result.refusal) throw InputError("gap scaling is refused: " + describe(*result.refusal, {}));
    return result.design.shape;
  }

  Direction direction_;
  StackabilityOptions measure_;
  Shape rest_;
  std::unique_ptr<DeformationModel> model_;
};

/// What is compared.
struct Shown {
  std::string name;
  Colour colour;
  MeasuredShape shape;
};

/// f along the line of samples through the largest gap of the first shape.
CurvePlot compared_gap_plot(const std::vector<Shown>& shapes, const Direction& direction) {
  const Window window = window_around(shapes.front().shape.shape, direction, gap_samples);
  CurvePlot plot;
  int row = 0;
  for (const Shown& shown : shapes) {
    const HeightField field = height_field_by_scanline(shown.shape.shape, direction, window);
    if (plot.series.empty()) row = std::max(maximum_gap(field).row, 0);
    const Eigen::MatrixXd values = gap(field);
    PlotSeries series{shown.name, shown.colour, {}};
    for (int i = 0; i < window.columns; ++i)
      series.points.emplace_back(window.sample(i, row).x(), values(i, row));
    plot.series.push_back(std::move(series));
  }
  const std::string unit = unit_symbol(shapes.front().shape.shape.unit);
  plot.x.title = "across" + (unit.empty() ? "" : ", " + unit);
  plot.y.title = "gap f" + (unit.empty() ? "" : ", " + unit);
  return plot;
}

Panel compared_panel(const Shown& shown, const Figure06Options& options) {
  const Direction up(shown.shape.measured.direction);
  const Scene scene = side_by_side({grounded_stack(shown.shape, 1, shown.colour),
                                    grounded_stack(shown.shape, options.copies, shown.colour)},
                                   up, options.camera);
  const Unit unit = shown.shape.shape.unit;
  return {scene_panel(scene, up, options.camera),
          shown.name,
          {"h " + length_text(shown.shape.measured.extent, unit),
           "f_max " + length_text(shown.shape.measured.f_max, unit)},
          1};
}

FigureResult make_figure_06(const Figure06Options& options, const ModelFolder& models) {
  const DesignRun run = design_run(options.task, models);
  const ImprovedShape ours = improved_shape(run);
  double factor = 1;
  const MeasuredShape naive =
      GapScaling(run.rest().shape, options).as_compact_as(ours.after.measured, factor);
  const std::vector<Shown> shapes = {{"original", original_colour, ours.before},
                                     {"structure-aware", palette::output, ours.after},
                                     {"gap scaling", palette::lower, naive}};
  FigureResult result;
  PanelRow row{{}, 0.25, PanelScale::common};
  const std::string unit = unit_symbol(ours.before.shape.unit);
  for (const Shown& shown : shapes) {
    row.panels.push_back(compared_panel(shown, options));
    const Stackability& measured = shown.shape.measured;
    result.numbers.push_back({shown.name + ": h", measured.extent, unit});
    result.numbers.push_back({shown.name + ": f_max", measured.f_max, unit});
    result.numbers.push_back({shown.name + ": S", measured.value});
  }
  result.numbers.push_back({"factor of the gap function", factor});
  const PanelRow plot{{{compared_gap_plot(shapes, *options.task.space.direction), "", {}, 1}}, 0.34};
  result.drawing = panel_sheet({plot, row});
  const double before = ours.before.measured.extent;
  result.claims = {{"both solutions are equally compact: a further copy adds the same height to the stack",
                    std::abs(naive.measured.f_max / ours.after.measured.f_max - 1) <= compactness_tolerance},
                   {"the structure-aware solution reaches its target and keeps the height",
                    run.reached() && keeps_height(ours)},
                   {"gap scaling squashes the object: its height falls with the gap, and S gains nothing",
                    naive.measured.extent < before * (1 + factor) / 2 &&
                        naive.measured.value < (ours.before.measured.value + ours.after.measured.value) / 2}};
  return result;
}

}  // namespace

Figure figure_06() {
  return figure(6, "Gap scaling against structure-aware deformation, equally compact", read_figure_06,
                make_figure_06);
}

}  // namespace stackabilization::figures
