#include "paper_figures/before_after.h"
#include "paper_figures/shown.h"

namespace stackabilization::figures {
namespace {

/// Alone, and a stack that can be seen through.
Panel see_through_panel(const MeasuredShape& shape, const StackedTask& options, const Colour& colour) {
  constexpr double see_through = 0.45;
  const Direction up(shape.measured.direction);
  Scene stack = grounded_stack(shape, options.copies, colour);
  for (SceneMesh& mesh : stack.meshes) mesh.opacity = see_through;
  const Scene scene = side_by_side({grounded_stack(shape, 1, colour), stack}, up, options.camera);
  return {scene_panel(scene, up, options.camera), "S " + ratio_text(shape.measured.value), {}, 1};
}

FigureResult make_figure_15(const StackedTask& options, const ModelFolder& models) {
  const DesignRun run = design_run(options.task, models);
  const ImprovedShape shapes = improved_shape(run);
  PanelRow row{{see_through_panel(shapes.before, options, palette::input),
                see_through_panel(shapes.after, options, palette::output)},
               0.62,
               PanelScale::common};
  PanelSheetOptions sheet;
  sheet.legend = before_after_entries();
  return {panel_sheet({row}, sheet),
          design_numbers("bottle", run),
          {{"free-form deformation of the surface reaches the stackability asked for", run.reached()},
           {"the height is kept", keeps_height(shapes)}}};
}

}  // namespace

Figure figure_15() {
  return figure(15, "A bottle, by deformation of its surface", read_stacked_task, make_figure_15);
}

}  // namespace stackabilization::figures
