#include <utility>

#include "paper_figures/before_after.h"
#include "paper_figures/shown.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/improvement/shape_change.h"

namespace stackabilization::figures {
namespace {

/// The same object, with some primitives.
struct PrimitiveVariant {
  std::string name;
  DesignTask task;
};

struct Figure11Options {
  std::vector<PrimitiveVariant> variants;
  Camera camera;
  int copies = 1;
};

Figure11Options read_figure_11(const Fields& fields) {
  Figure11Options options{{}, read_camera(fields), read_copies(fields)};
  for (const Fields& variant : fields.objects("variants"))
    options.variants.push_back({variant.text("name"), read_design_task(variant)});
  return options;
}

double stackability_by(BoxModel boxes, const MeasuredShape& shape) {
  return stackability(shape.shape, Direction(shape.measured.direction), {ContactSemantics::solid, boxes})
      .value;
}

std::vector<std::string> captions(const MeasuredShape& shape) {
  return {"S frame " + ratio_text(stackability_by(BoxModel::frame, shape)),
          "S oriented " + ratio_text(stackability_by(BoxModel::oriented, shape))};
}

/// How much the designs of two runs differ, fraction of the diagonal.
double difference(const DesignRun& a, const DesignRun& b) {
  return shape_change(a.best().design.shape, b.best().design.shape).root_mean_square;
}

FigureResult make_figure_11(const Figure11Options& options, const ModelFolder& models) {
  FigureResult result;
  PanelRow alone{{}, 0.24, PanelScale::common}, stacks{{}, 0.36, PanelScale::common};
  const auto show = [&](const std::string& name, const MeasuredShape& shape, const Colour& colour,
                        const std::vector<std::string>& lines) {
    alone.panels.push_back({single_stack_panel(shape, 1, colour, options.camera), name, {}, 1});
    stacks.panels.push_back(
        {single_stack_panel(shape, options.copies, colour, options.camera), "", lines, 1});
  };
  const std::vector<DesignRun> runs = design_runs(tasks_of(options.variants), models);
  bool reached = true, kept = true;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const PrimitiveVariant& variant = options.variants[k];
    const DesignRun& run = runs[k];
    const ImprovedShape shapes = improved_shape(run);
    if (k == 0) show("original", shapes.before, palette::input, captions(shapes.before));
    std::vector<std::string> lines = captions(shapes.after);
    lines.push_back("D " + ratio_text(run.best().energy.distortion.total()));
    show(variant.name, shapes.after, palette::output, lines);
    for (const auto& [when, shape] : {std::pair{" before", &shapes.before}, {" after", &shapes.after}})
      for (const auto& [model, name] :
           {std::pair{BoxModel::frame, ": S (frame)"}, {BoxModel::oriented, ": S (oriented)"}})
        result.numbers.push_back({variant.name + name + when, stackability_by(model, *shape)});
    result.numbers.push_back({variant.name + ": D", run.best().energy.distortion.total()});
    reached = reached && run.reached();
    kept = kept && keeps_height(shapes);
  }
  const double apart = difference(runs.front(), runs.back());
  result.numbers.push_back({"S asked for", options.variants.front().task.requirements.target});
  result.numbers.push_back({"difference of the solutions, RMS over the diagonal", apart});
  result.drawing = panel_sheet({alone, stacks});
  result.claims = {{"both kinds of primitives reach the stackability asked for", reached},
                   {"both keep the height of the table", kept},
                   {"the two solutions differ", apart > tolerance::relative}};
  return result;
}

}  // namespace

Figure figure_11() {
  return figure(11, "Cuboids against generalized cylinders on one table", read_figure_11, make_figure_11);
}

}  // namespace stackabilization::figures
