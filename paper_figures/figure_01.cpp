#include "paper_figures/before_after.h"
#include "paper_figures/design_run.h"
#include "paper_figures/figure.h"
#include "paper_figures/shown.h"

namespace stackabilization::figures {
namespace {

struct Figure01Options {
  std::vector<NamedTask> objects;
  int copies = 5;
};

Figure01Options read_figure_01(const Fields& fields) {
  Figure01Options options{{}, read_copies(fields, 2)};
  for (const Fields& object : fields.objects("objects")) options.objects.push_back(read_named_task(object));
  return options;
}

/// Both stacks with their heights.
ScenePanel panel_with_heights(const ImprovedShape& shapes, const NamedTask& object, int copies) {
  ScenePanel panel = stacks_panel(shapes, copies, object.camera);
  panel.over.dimensions = {stack_dimension(shapes.before, copies, Anchor::left),
                           stack_dimension(shapes.after, copies, Anchor::right)};
  return panel;
}

FigureResult make_figure_01(const Figure01Options& options, const ModelFolder& models) {
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
        {panel_with_heights(shapes, object, options.copies),
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
  return figure(1, "Stacks before and after, and the height they save", read_figure_01, make_figure_01);
}

}  // namespace stackabilization::figures
