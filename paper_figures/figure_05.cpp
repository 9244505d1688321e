#include <algorithm>
#include <cmath>

#include "paper_figures/figure.h"
#include "paper_figures/shown.h"
#include "stackabilization/core/number_text.h"
#include "stackabilization/rendering/foot.h"
#include "stackabilization/rendering/stacking_scene.h"
#include "stackabilization/stacking/rigid_transform.h"

namespace stackabilization::figures {
namespace {

struct Figure05Options {
  ModelSource model;
  Direction from;             ///< the direction that is tilted
  Direction axis;             ///< about which it is tilted, right-handed
  std::vector<double> tilts;  ///< to be shown, degrees
  std::vector<double> sweep;  ///< of the curve: first and last tilt, degrees
  int copies = 3;
  Camera camera;
};

Figure05Options read_figure_05(const Fields& fields) {
  Figure05Options options{read_model_source(fields.object("model")),
                          Direction(fields.vector("from")),
                          Direction(fields.vector("axis")),
                          fields.numbers("tilts"),
                          fields.numbers("sweep"),
                          read_copies(fields, 2),
                          read_camera(fields)};
  if (options.sweep.size() != 2 || !(options.sweep[0] < options.sweep[1]))
    fields.refuse("sweep", "two numbers, the smaller one first");
  return options;
}

Direction tilted(const Figure05Options& options, double degrees) {
  const RigidTransform turn = rotation_about({Eigen::Vector3d::Zero(), options.axis}, degrees);
  return Direction(turn.rotation * options.from.unit());
}

/// A stack along a direction, with an arrow that says which.
Panel tilted_stack_panel(const Shape& shape, const Stackability& measured, const Figure05Options& options) {
  const Eigen::Vector3d along = Direction(measured.direction).unit();
  const Shape lowest = on_ground(shape, options.from);
  ScenePanel panel =
      scene_panel(stack_scene(copies_of(lowest, measured.f_max * along, options.copies), palette::input),
                  options.from, options.camera);
  const Eigen::Vector3d centre = axis_aligned_box(lowest.vertices).centre;
  const Eigen::Vector3d start =
      centre + ((options.copies - 1) * measured.f_max + 0.55 * measured.extent) * along;
  panel.over.arrows = {{start, start + 0.4 * measured.extent * along}};
  return {std::move(panel), "", {}, 1};
}

CurvePlot sweep_plot(const StackabilitySolver& solver, const Figure05Options& options) {
  constexpr int steps = 120;
  CurvePlot plot;
  plot.x = {"tilt of the direction in degrees", Range{options.sweep[0], options.sweep[1]}};
  plot.y.title = "S";
  PlotSeries curve{"", palette::upper, {}}, shown{"", palette::contact, {}, PlotLine::none, PlotMark::circle};
  for (int k = 0; k <= steps; ++k) {
    const double degrees = options.sweep[0] + (options.sweep[1] - options.sweep[0]) * k / steps;
    curve.points.emplace_back(degrees, solver.measure(tilted(options, degrees)).value);
  }
  for (const double degrees : options.tilts)
    shown.points.emplace_back(degrees, solver.measure(tilted(options, degrees)).value);
  plot.series = {curve, shown};
  return plot;
}

FigureResult make_figure_05(const Figure05Options& options, const ModelFolder& models) {
  const Shape shape = models.read(options.model);
  const StackabilitySolver solver(shape);
  PanelRow stacks, plot;
  stacks.scale = PanelScale::common;
  stacks.height = 0.5;
  plot.height = 0.36;
  FigureResult result;
  result.kind = FigureKind::plot;
  std::vector<double> values;
  for (const double degrees : options.tilts) {
    const Stackability measured = solver.measure(tilted(options, degrees));
    stacks.panels.push_back(tilted_stack_panel(shape, measured, options));
    stacks.panels.back().title = significant_text(degrees, 5) + "°:  S = " + ratio_text(measured.value);
    const std::string at = " at " + significant_text(degrees, 5) + " degrees";
    result.numbers.push_back({"S" + at, measured.value});
    result.numbers.push_back({"f_max / h" + at, measured.f_max / measured.extent});
    values.push_back(measured.value);
  }
  plot.panels = {{sweep_plot(solver, options), "", {}, 1}};
  const auto [least, largest] = std::minmax_element(values.begin(), values.end());
  const auto [first, last] = std::minmax_element(options.tilts.begin(), options.tilts.end());
  constexpr double considerable = 0.3;
  result.claims = {{"a tilt of the direction by at most " + significant_text(*last - *first, 5) +
                        " degrees changes S by more than 0.3",
                    *largest - *least > considerable}};
  result.drawing = panel_sheet({stacks, plot});
  return result;
}

}  // namespace

Figure figure_05() {
  return figure(5, "Changing the stacking direction slightly changes S considerably", read_figure_05,
                make_figure_05);
}

}  // namespace stackabilization::figures
