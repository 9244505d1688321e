#include <algorithm>
#include <cmath>

#include "paper_figures/before_after.h"
#include "paper_figures/shown.h"
#include "stackabilization/rendering/handle_lines.h"
#include "stackabilization/rendering/stacking_scene.h"

namespace stackabilization::figures {
namespace {

struct Object {
  NamedTask named;
  double height = 1;  ///< of its row, fraction of the width of the sheet
};

struct Figure08Options {
  std::vector<Object> objects;
  int states = 2;  ///< shown of each
};

Figure08Options read_figure_08(const Fields& fields) {
  constexpr int max_states = 8;
  Figure08Options options;
  options.states = fields.whole("states", 2, max_states);
  for (const Fields& object : fields.objects("objects"))
    options.objects.push_back({read_named_task(object), read_row_height(object)});
  return options;
}

/// A design on the way, and the edits that come next.
struct State {
  int edits = 0;
  Design design;
  MeasuredShape measured;
  std::vector<Edit> next;
};

/// Numbers of edits from none to all, evenly spread.
std::vector<int> steps(int edits, int states) {
  std::vector<int> result;
  for (int k = 0; k < states; ++k)
    result.push_back(static_cast<int>(std::lround(double(k) * edits / (states - 1))));
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

std::vector<State> path(const DesignRun& run, int count) {
  const std::vector<Edit>& edits = run.best().design.edits;
  const Direction direction(run.best().direction);
  const Requirements& requirements = run.task->checker().requirements();
  const DeformationConstraints constraints = deformation_constraints(requirements, run.rest(), direction);
  const std::vector<int> shown = steps(static_cast<int>(edits.size()), count);
  std::vector<State> states;
  for (std::size_t k = 0; k < shown.size(); ++k) {
    State state;
    state.edits = shown[k];
    state.design = run.task->space().deformed({edits.begin(), edits.begin() + shown[k]}, constraints).design;
    state.measured = measured_shape(state.design.shape, direction, requirements.measure);
    if (k + 1 < shown.size()) state.next.assign(edits.begin() + shown[k], edits.begin() + shown[k + 1]);
    states.push_back(std::move(state));
  }
  return states;
}

/// Contact parts orange, the handles that are used next red; the last state is green.
ScenePanel state_panel(const State& state, const Camera& camera) {
  const Shape& shape = state.design.shape;
  const bool last = state.next.empty();
  SceneMesh mesh{shape,
                 std::vector<Colour>(shape.part_names.size(), last ? palette::output : palette::input)};
  ScenePanel panel = scene_panel({}, Direction(state.measured.measured.direction), camera);
  if (!last) {
    for (const ContactRegion& region : state.measured.contacts)
      for (const int part : {region.upper_part, region.lower_part})
        mesh.colours.at(static_cast<std::size_t>(part)) = palette::lower;
    SceneLines lines{{}, palette::contact, 4};
    for (const Edit& edit : state.next) {
      if (edit.handle.kind == HandleKind::part)
        mesh.colours.at(static_cast<std::size_t>(edit.handle.part)) = palette::contact;
      for (Points& line : handle_lines(edit.handle, shape, state.design.primitives))
        lines.polylines.push_back(std::move(line));
    }
    panel.over.lines.push_back(std::move(lines));
  }
  panel.scene.add(std::move(mesh));
  return panel;
}

std::string caption(const State& state, std::size_t all) {
  if (state.edits == 0) return "start";
  const std::string edits = std::to_string(state.edits) + (state.edits == 1 ? " edit" : " edits");
  return static_cast<std::size_t>(state.edits) == all ? "solution: " + edits : edits;
}

FigureResult make_figure_08(const Figure08Options& options, const ModelFolder& models) {
  FigureResult result;
  std::vector<PanelRow> rows;
  bool reached = true, better = true;
  for (const auto& [object, height] : options.objects) {
    const DesignRun run = design_run(object.task, models);
    const std::vector<State> states = path(run, options.states);
    const std::size_t edits = run.best().design.edits.size();
    rows.push_back({{}, height, PanelScale::common});
    for (const State& state : states) {
      const std::string how = caption(state, edits);
      const double s = state.measured.measured.value;
      rows.back().panels.push_back({state_panel(state, object.camera), "S " + ratio_text(s), {how}, 1});
      result.numbers.push_back({object.name + ", " + how + ": S", s});
    }
    reached = reached && run.reached();
    better = better && states.back().measured.measured.value > states.front().measured.measured.value;
  }
  PanelSheetOptions sheet;
  sheet.legend = {{LegendMark::swatch, palette::lower, "contact parts"},
                  {LegendMark::ring, palette::contact, "handles edited next"},
                  {LegendMark::swatch, palette::output, "solution"}};
  result.drawing = panel_sheet(rows, sheet);
  result.claims = {{"the edits made at contacts lead from the start to the stackability asked for", reached},
                   {"the solution stacks better than the start", better}};
  return result;
}

}  // namespace

Figure figure_08() {
  return figure(8, "Progress on a mug and a table: contact parts, handles, and S", read_figure_08,
                make_figure_08);
}

}  // namespace stackabilization::figures
