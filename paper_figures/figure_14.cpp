#include <algorithm>

#include "paper_figures/before_after.h"
#include "paper_figures/shown.h"

namespace stackabilization::figures {
namespace {

/// A piece of the object, by what is left out of it.
struct Piece {
  std::string name;
  DesignTask task;
};

struct Figure14Options {
  ModelSource whole;
  Direction direction;
  std::vector<Piece> pieces;
  Camera camera;
  int copies = 1;
};

Figure14Options read_figure_14(const Fields& fields) {
  Figure14Options options{read_model_source(fields.object("whole")),
                          Direction(fields.vector("direction")),
                          {},
                          read_camera(fields),
                          read_copies(fields)};
  for (const Fields& piece : fields.objects("pieces"))
    options.pieces.push_back({piece.text("name"), read_design_task(piece)});
  return options;
}

/// S of an object in pieces that are stacked each by itself: see improvement/partition.h.
double together(const std::vector<Stackability>& pieces, double box_volume) {
  double used = 0;
  for (const Stackability& piece : pieces) used += piece.box_volume * (1 - piece.value);
  return 1 - used / box_volume;
}

FigureResult make_figure_14(const Figure14Options& options, const ModelFolder& models) {
  const MeasuredShape whole = measured_shape(models.read(options.whole), options.direction);
  FigureResult result;
  PanelRow row{{}, 0.6, PanelScale::common};
  row.panels.push_back({single_stack_panel(whole, options.copies, palette::input, options.camera),
                        "whole",
                        {"S " + ratio_text(whole.measured.value)},
                        0.6});
  result.numbers.push_back({"whole: S", whole.measured.value});
  std::vector<Stackability> before, after;
  std::vector<std::string> parts, wanted = whole.shape.part_names;
  bool reached = true;
  const std::vector<DesignRun> runs = design_runs(tasks_of(options.pieces), models);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const Piece& piece = options.pieces[k];
    const DesignRun& run = runs[k];
    const ImprovedShape shapes = improved_shape(run);
    row.panels.push_back(
        {stacks_panel(shapes, options.copies, options.camera), piece.name, {change_text(shapes)}, 1});
    for (const Number& number : design_numbers(piece.name, run)) result.numbers.push_back(number);
    before.push_back(shapes.before.measured);
    after.push_back(shapes.after.measured);
    const std::vector<std::string>& own = run.rest().shape.part_names;
    parts.insert(parts.end(), own.begin(), own.end());
    reached = reached && run.reached();
  }
  std::sort(parts.begin(), parts.end());
  std::sort(wanted.begin(), wanted.end());
  const double cut = together(before, whole.measured.box_volume),
               improved = together(after, whole.measured.box_volume);
  result.numbers.push_back({"all pieces, as they are cut: S", cut});
  result.numbers.push_back({"all pieces, improved: S", improved});
  PanelSheetOptions sheet;
  sheet.legend = before_after_entries();
  sheet.notes = {"All pieces together: S " + ratio_text(cut) + " as they are cut, " + ratio_text(improved) +
                 " improved"};
  result.drawing = panel_sheet({row}, sheet);
  result.claims = {{"the pieces hold every part of the object once", parts == wanted},
                   {"every piece reaches the stackability asked for", reached},
                   {"in pieces it stacks better than as a whole, and still better once they are improved",
                    cut > whole.measured.value && improved > cut}};
  return result;
}

}  // namespace

Figure figure_14() {
  return figure(14, "Taken apart, each piece stacks", read_figure_14, make_figure_14);
}

}  // namespace stackabilization::figures
