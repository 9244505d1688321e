#include "paper_figures/before_after.h"
#include "paper_figures/design_run.h"
#include "paper_figures/figure.h"
#include "paper_figures/shown.h"

namespace stackabilization::figures {
namespace {

struct Options {
  std::vector<NamedTask> objects;
  int copies = 5;
};

Options read(const Fields& fields) {
  Options options{{}, fields.whole("copies", 2, 20)};
  for (const Fields& object : fields.objects("objects")) options.objects.push_back(read_named_task(object));
  return options;
}

double stack_height(const MeasuredShape& shape, int copies) {
  return shape.measured.extent + (copies - 1) * shape.measured.f_max;
}

/// Both stacks with their heights.
ScenePanel panel_of(const ImprovedShape& shapes, const NamedTask& object, int copies) {
  ScenePanel panel = stacks_panel(shapes, copies, object.camera);
  const Eigen::Vector3d up = Direction(shapes.after.measured.direction).unit();
  const auto dimension = [&](const MeasuredShape& shape, Anchor side) {
    const double height = stack_height(shape, copies);
    return SceneDimension{Eigen::Vector3d::Zero(), height * up, length_text(height, shape.shape.unit), side};
  };
  panel.over.dimensions = {dimension(shapes.before, Anchor::left), dimension(shapes.after, Anchor::right)};
  return panel;
}

FigureResult make(const Options& options, const ModelFolder& models) {
  FigureResult result;
  PanelRow row;
  row.height = 0.62;
  bool reached = true, kept = true, lower = true;
  const std::vector<DesignRun> runs = design_runs(tasks_of(options.objects), models);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const NamedTask& object = options.objects[k];
    const DesignRun& run = runs[k];
    const ImprovedShape shapes = improved_shape(run);
    const double before = stack_height(shapes.before, options.copies),
                 after = stack_height(shapes.after, options.copies);
    reached = reached && run.reached();
    kept = kept && keeps_height(shapes);
    lower = lower && after < before;
    row.panels.push_back(
        {panel_of(shapes, object, options.copies),
         std::to_string(options.copies) + " copies: " + percent_text(1 - after / before) + " less high",
         {change_text(shapes)},
         1});
    for (Number& number : design_numbers(object.name, run)) result.numbers.push_back(std::move(number));
    const std::string stack = object.name + ": height of " + std::to_string(options.copies) + " copies";
    const std::string unit = unit_symbol(shapes.before.shape.unit);
    result.numbers.push_back({stack + " before", before, unit});
    result.numbers.push_back({stack + " after", after, unit});
    result.numbers.push_back({object.name + ": saved height", 1 - after / before});
  }
  PanelSheetOptions sheet;
  sheet.legend = before_after_entries();
  result.drawing = panel_sheet({row}, sheet);
  result.claims = {{"every stack is lower than before", lower},
                   {"every object reaches the stackability asked for, all requirements held", reached},
                   {"no object changes its height along the direction", kept}};
  return result;
}

}  // namespace

Figure figure_01() {
  return figure(1, "Stacks before and after, and the height they save", read, make);
}

}  // namespace stackabilization::figures
