#include "paper_figures/before_after.h"
#include "paper_figures/shown.h"

namespace stackabilization::figures {
namespace {

struct Options {
  DesignTask task;
  Camera camera;
  int copies = 1;
};

Options read(const Fields& fields) {
  constexpr int most_copies = 20;
  return {read_design_task(fields.object("task")), read_camera(fields),
          fields.whole("copies", 1, most_copies)};
}

/// Alone, and a stack that can be seen through.
Panel panel_of(const MeasuredShape& shape, const Options& options, const Colour& colour) {
  constexpr double see_through = 0.45;
  const Direction up(shape.measured.direction);
  Scene stack = grounded_stack(shape, options.copies, colour);
  for (SceneMesh& mesh : stack.meshes) mesh.opacity = see_through;
  const Scene scene = side_by_side({grounded_stack(shape, 1, colour), stack}, up, options.camera);
  return {scene_panel(scene, up, options.camera), "S " + ratio_text(shape.measured.value), {}, 1};
}

FigureResult make(const Options& options, const ModelFolder& models) {
  const DesignRun run = design_run(options.task, models);
  const ImprovedShape shapes = improved_shape(run);
  PanelRow row{
      {panel_of(shapes.before, options, palette::input), panel_of(shapes.after, options, palette::output)},
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
  return figure(15, "A bottle, by deformation of its surface", read, make);
}

}  // namespace stackabilization::figures
