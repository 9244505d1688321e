#include <algorithm>
#include <sstream>

#include "paper_figures/before_after.h"
#include "paper_figures/shown.h"
#include "stackabilization/improvement/removal.h"
#include "stackabilization/rendering/stacking_scene.h"
#include "stackabilization/shape/errors.h"
#include "stackabilization/stacking/search.h"

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

/// The two copies that block each other: the parts that touch in full, the rest pale.
Scene blocked_scene(const MeasuredShape& shape, const Blocker& blocker) {
  const Direction direction(shape.measured.direction);
  const Eigen::Vector3d lift = shape.measured.f_max * direction.unit();
  Scene scene;
  for (const auto& [part, shift] :
       {std::pair{blocker.upper_part, Eigen::Vector3d(0, 0, 0)}, {blocker.lower_part, lift}}) {
    std::vector<Colour> colours(shape.shape.part_names.size(), mix(palette::input, palette::white, 0.55));
    colours.at(static_cast<std::size_t>(part)) = palette::lower;
    scene.add({transformed(shape.shape, Eigen::Matrix3d::Identity(), shift), colours});
  }
  return scene;
}

/// Only the two parts, one of each copy, with the region where they touch.
Scene pair_scene(const MeasuredShape& shape, const Blocker& blocker) {
  const Direction direction(shape.measured.direction);
  const Eigen::Vector3d lift = shape.measured.f_max * direction.unit();
  const Shape above = extract_part(shape.shape, blocker.lower_part);
  Scene scene = touching_scene({extract_part(shape.shape, blocker.upper_part), {palette::input}},
                               shape.contacts, direction);
  scene.add({transformed(above, Eigen::Matrix3d::Identity(), lift), {palette::lower}, 0.6});
  return scene;
}

/// Where the two copies touch, drawn over everything.
SceneOverlay contact_rings(const MeasuredShape& shape) {
  constexpr double of_extent = 0.09;
  SceneOverlay over;
  for (const ContactRegion& region : shape.contacts)
    over.rings.push_back({region.upper_centre, of_extent * shape.measured.extent, palette::contact});
  return over;
}

std::string sentence_about_the_first_blocker(const Diagnosis& diagnosis, const StructuredShape& rest) {
  std::istringstream lines(text(diagnosis, rest));
  std::string line;
  std::getline(lines, line);  // what was reached
  std::getline(lines, line);
  return line;
}

const Remedy& removal_of(const Diagnosis& diagnosis) {
  const auto found =
      std::find_if(diagnosis.remedies.begin(), diagnosis.remedies.end(),
                   [](const Remedy& remedy) { return remedy.kind == Remedy::Kind::remove_part; });
  if (found == diagnosis.remedies.end())
    throw InputError("the diagnosis names no part whose removal would help");
  return *found;
}

/// Along its best direction.
MeasuredShape best_stacked(const Shape& shape, const StackabilityOptions& measure) {
  const StackabilitySolver solver(shape, measure);
  return measured_shape(shape, Direction(best_direction(solver).best.direction), measure);
}

/// What the figure is about.
struct Story {
  MeasuredShape lying;  ///< along the best direction
  DesignRun refused;    ///< by the search of the paper
  DesignRun further;    ///< what further edits make of it
};

DesignTask beyond_the_paper(DesignTask task) {
  task.options.preset = ImprovementPreset::refined;
  task.options.search.expansions = 1;
  return task;
}

std::vector<Panel> panels(const Options& options, const Story& story, const Remedy& remedy) {
  const DesignRun& run = story.refused;
  const MeasuredShape& lying = story.lying;
  const ImprovedShape shapes = improved_shape(run);
  const Direction up(shapes.after.measured.direction);
  const MeasuredShape rest =
      measured_shape(without_parts(run.rest(), remedy.parts).shape, up, run.checker->requirements().measure);
  ScenePanel blocked =
      scene_panel(blocked_scene(shapes.after, run.result.diagnosis->blockers.front()), up, options.camera);
  blocked.over = contact_rings(shapes.after);
  const auto stack = [&](const MeasuredShape& shape, const Colour& colour) {
    return scene_panel(grounded_stack(shape, options.copies, colour), Direction(shape.measured.direction),
                       options.camera);
  };
  const auto s_of = [](const MeasuredShape& shape) {
    return std::vector<std::string>{"S " + ratio_text(shape.measured.value)};
  };
  const MeasuredShape further = improved_shape(story.further).after;
  return {{stack(lying, palette::input), "best direction", s_of(lying), 1},
          {std::move(blocked), "upright: refused", s_of(shapes.after), 1},
          {stack(rest, palette::output), remedy.what, s_of(rest), 1},
          {stack(further, palette::output), "further edits", s_of(further), 1}};
}

FigureResult make(const Options& options, const ModelFolder& models) {
  const DesignTask& task = options.task;
  const StructuredShape rest = structured_shape(task, models);
  const Story story{best_stacked(rest.shape, task.requirements.measure), design_run(rest, task),
                    design_run(rest, beyond_the_paper(task))};
  const DesignRun& run = story.refused;
  if (!run.result.diagnosis || run.result.diagnosis->blockers.empty())
    throw InputError("the target " + ratio_text(task.requirements.target) +
                     " was reached: nothing to explain");
  const Diagnosis& diagnosis = *run.result.diagnosis;
  const Remedy& remedy = removal_of(diagnosis);
  const std::string why = sentence_about_the_first_blocker(diagnosis, rest);
  const MeasuredShape after = improved_shape(run).after;
  const Panel pair{scene_panel(pair_scene(after, diagnosis.blockers.front()),
                               Direction(after.measured.direction), options.camera),
                   "",
                   {why},
                   1};
  PanelSheetOptions sheet;
  sheet.legend = {{LegendMark::swatch, palette::lower, "parts that block each other"},
                  {LegendMark::ring, palette::contact, "where they touch"}};
  FigureResult result;
  result.drawing = panel_sheet({{panels(options, story, remedy), 0.55}, {{pair}, 0.3}}, sheet);
  result.numbers = {{"S asked for", task.requirements.target},
                    {"S along the best direction", story.lying.measured.value},
                    {"S upright", run.result.before.measured.value},
                    {"S reached by the search of the paper", diagnosis.reached},
                    {"why not more", why},
                    {"remedy", remedy.what},
                    {"S with the remedy", remedy.stackability},
                    {"S reached by further edits", story.further.best().measured.value},
                    {"D of these", story.further.best().energy.distortion.total()}};
  result.claims = {
      {"the search of the paper does not reach the target, and the pair of parts that blocks it is named",
       !run.reached()},
      {"leaving parts out would help", remedy.stackability > diagnosis.reached},
      {"edits beyond the paper's reach the target", story.further.reached()}};
  return result;
}

}  // namespace

Figure figure_12() {
  return figure(12, "A swivel chair that the search of the paper cannot make stack, and why", read, make);
}

}  // namespace stackabilization::figures
