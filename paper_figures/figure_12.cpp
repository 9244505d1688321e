#include <utility>

#include "paper_figures/before_after.h"
#include "paper_figures/shown.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/improvement/removal.h"
#include "stackabilization/stacking/search.h"

namespace stackabilization::figures {
namespace {

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

/// Where the two copies touch, drawn over everything.
SceneOverlay contact_rings(const MeasuredShape& shape) {
  constexpr double of_extent = 0.09;
  SceneOverlay over;
  for (const ContactRegion& region : shape.contacts)
    over.rings.push_back({region.upper_centre, of_extent * shape.measured.extent, palette::contact});
  return over;
}

/// The class of symmetric parts without which the object at rest stacks best.
Removal best_removal(const DesignRun& run) {
  RemovalOptions options;
  options.measure = run.task->checker().requirements().measure;
  options.directions = {run.best().direction};
  const std::vector<Removal> all = removals(run.rest(), options);
  if (all.empty()) throw InputError("the model has no part that could be left out");
  return all.front();
}

/// Along its best direction.
MeasuredShape best_stacked(const Shape& shape, const StackabilityOptions& measure) {
  const StackabilitySolver solver(shape, measure);
  return measured_shape(shape, Direction(best_direction(solver).best.direction), measure);
}

/// What the figure is about.
struct Story {
  MeasuredShape lying;    ///< along the best direction
  DesignRun run;          ///< that did not reach its target
  ImprovedShape upright;  ///< at rest, and what came nearest
  Removal removal;
  MeasuredShape rest;  ///< what stays of the object at rest

  const Diagnosis& diagnosis() const { return *run.result.diagnosis; }
};

Story story_of(const StackedTask& options, const ModelFolder& models) {
  DesignRun run = design_run(options.task, models);
  if (!run.result.diagnosis || run.result.diagnosis->blockers.empty())
    throw InputError("the target " + ratio_text(options.task.requirements.target) +
                     " was reached: nothing to explain");
  const StackabilityOptions measure = run.task->checker().requirements().measure;
  Removal removal = best_removal(run);
  MeasuredShape rest =
      measured_shape(without_parts(run.rest(), removal.parts).shape, Direction(removal.direction), measure);
  MeasuredShape lying = best_stacked(run.rest().shape, measure);
  ImprovedShape upright = improved_shape(run);
  return {std::move(lying), std::move(run), std::move(upright), std::move(removal), std::move(rest)};
}

std::string without_text(const Removal& removal, const Shape& shape) {
  std::string text = "without ";
  for (const int part : removal.parts)
    text += (part == removal.parts.front() ? "" : ", ") + shape.part_names[static_cast<std::size_t>(part)];
  return text;
}

PanelRow stacks(const StackedTask& options, const Story& story) {
  PanelRow row{{}, 0.5, PanelScale::common};
  const auto add = [&](const std::string& title, const MeasuredShape& shape, const Colour& colour) {
    row.panels.push_back({single_stack_panel(shape, options.copies, colour, options.camera),
                          title,
                          {"S " + ratio_text(shape.measured.value)},
                          1});
  };
  add("best direction", story.lying, palette::input);
  add("upright", story.upright.before, palette::input);
  add(without_text(story.removal, story.run.rest().shape), story.rest, palette::output);
  return row;
}

/// The nearest design stacked on itself, what blocks it in colour.
PanelRow blocked(const StackedTask& options, const Story& story, const std::string& why) {
  const MeasuredShape& shape = story.upright.after;
  const Direction up(shape.measured.direction);
  const Blocker& blocker = story.diagnosis().blockers.front();
  ScenePanel both = scene_panel(blocked_scene(shape, blocker), up, options.camera);
  both.over = contact_rings(shape);
  return {{{std::move(both), "", {why}, 1}}, 0.42};
}

FigureResult make_figure_12(const StackedTask& options, const ModelFolder& models) {
  const Story story = story_of(options, models);
  const DesignRun& run = story.run;
  const std::string why = describe(story.diagnosis().blockers.front(), run.rest().structure);
  PanelSheetOptions sheet;
  sheet.legend = {{LegendMark::swatch, palette::lower, "parts that block each other"},
                  {LegendMark::ring, palette::contact, "where copies touch"}};
  FigureResult result;
  result.drawing = panel_sheet({stacks(options, story), blocked(options, story, why)}, sheet);
  const double target = options.task.requirements.target, reached = story.diagnosis().reached;
  result.numbers = {{"S along the best direction", story.lying.measured.value},
                    {"S upright", run.result.before.measured.value},
                    {"S asked for", target},
                    {"S reached", reached},
                    {"D of what came nearest", run.best().energy.distortion.total()},
                    {"why not more", why},
                    {"remedy", without_text(story.removal, run.rest().shape)},
                    {"S with the remedy, nothing else changed", story.removal.stackability}};
  result.claims = {
      {"another direction stacks better than upright",
       story.lying.measured.value > run.result.before.measured.value},
      {"the target is refused, and the pair of parts that blocks it is named", !run.reached()},
      {"leaving a part out helps", story.removal.stackability > run.result.before.measured.value}};
  return result;
}

}  // namespace

Figure figure_12() {
  return figure(12, "A swivel chair that is refused its target, and why", read_stacked_task, make_figure_12);
}

}  // namespace stackabilization::figures
