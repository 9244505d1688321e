#include "paper_figures/gallery.h"

#include <algorithm>
#include <utility>

#include "paper_figures/before_after.h"
#include "paper_figures/shown.h"

namespace stackabilization::figures {
namespace {

struct GalleryOptions {
  std::vector<NamedTask> objects;
  std::size_t columns = 1;
  int copies = 1;
  double height = 1;  ///< of a row of pictures, fraction of the width of the sheet
};

GalleryOptions read_gallery(const Fields& fields) {
  GalleryOptions options;
  constexpr int max_columns = 8;
  options.columns = static_cast<std::size_t>(fields.whole("columns", 1, max_columns));
  options.copies = read_copies(fields);
  options.height = read_row_height(fields);
  for (const Fields& object : fields.objects("objects")) options.objects.push_back(read_named_task(object));
  return options;
}

FigureResult make_gallery(const GalleryOptions& options, const ModelFolder& models) {
  FigureResult result;
  std::vector<PanelRow> rows;
  bool reached = true, kept = true, better = true;
  const std::vector<DesignRun> runs = design_runs(tasks_of(options.objects), models);
  for (std::size_t k = 0; k < options.objects.size(); ++k) {
    const NamedTask& object = options.objects[k];
    const DesignRun& run = runs[k];
    const ImprovedShape shapes = improved_shape(run);
    reached = reached && run.reached();
    kept = kept && keeps_height(shapes);
    better = better && shapes.after.measured.value > shapes.before.measured.value;
    if (k % options.columns == 0) rows.push_back({{}, options.height});
    rows.back().panels.push_back(
        {stacks_panel(shapes, options.copies, object.camera), object.name, {change_text(shapes)}, 1});
    const std::vector<Number> numbers = design_numbers(object.name, run);
    result.numbers.insert(result.numbers.end(), numbers.begin(), numbers.end());
  }
  PanelSheetOptions sheet;
  sheet.legend = before_after_entries();
  result.drawing = panel_sheet(rows, sheet);
  result.claims = {{"every object stacks better than before", better},
                   {"every object reaches the stackability asked for, all requirements held", reached},
                   {"no object changes its height along the direction", kept}};
  return result;
}

}  // namespace

Figure gallery_figure(int number, std::string title) {
  return figure(number, std::move(title), read_gallery, make_gallery);
}

}  // namespace stackabilization::figures
