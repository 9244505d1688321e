#pragma once

#include <string>
#include <vector>

#include "paper_figures/design_run.h"
#include "paper_figures/figure.h"
#include "stackabilization/rendering/panel_sheet.h"

/// Designs before (yellow) and after (green), for figures.
namespace stackabilization::figures {

/// One of several objects that a figure makes stackable.
struct NamedTask {
  std::string name;
  DesignTask task;
  Camera camera;
};

/// Entries "name" and "camera" besides those of the task.
NamedTask read_named_task(const Fields& fields);

/// One design that is shown in stacks.
struct StackedTask {
  DesignTask task;
  Camera camera;
  int copies = 1;  ///< in a stack
};

/// Entries "task", "camera" and "copies" (1 to 20).
StackedTask read_stacked_task(const Fields& fields);

/// Entry "height": of a row of panels, fraction of the width of the sheet.
double read_row_height(const Fields& fields);

/// Scenes next to each other, from left to right as `camera` sees them, each on the ground.
Scene side_by_side(const std::vector<Scene>& scenes, const Direction& up, const Camera& camera);

/// Height of equal copies above each other, model units.
double stack_height(const MeasuredShape& shape, int copies);

/// The same beside a stack whose foot is at the origin.
SceneDimension stack_dimension(const MeasuredShape& shape, int copies, Anchor side);

/// Equal copies above each other, the first one's foot at the origin.
Scene grounded_stack(const MeasuredShape& shape, int copies, const Colour& colour);

/// One such stack, or one shape alone.
ScenePanel single_stack_panel(const MeasuredShape& shape, int copies, const Colour& colour,
                              const Camera& camera);

/// A stack before and one after, as high as they come, in one scale.
ScenePanel stacks_panel(const ImprovedShape& shapes, int copies, const Camera& camera);

/// "S 0.329 to 0.500".
std::string change_text(const ImprovedShape& shapes);

/// S before and after, D and the height kept, under the name of the object.
std::vector<Number> design_numbers(const std::string& name, const DesignRun& run);

/// Is h(M, r) of the design what it was, to tolerance::relative?
bool keeps_height(const ImprovedShape& shapes);

/// "before" and "after".
std::vector<LegendEntry> before_after_entries();

}  // namespace stackabilization::figures
