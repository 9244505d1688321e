#include "apps/suggest/suggest_run.h"

#include "apps/common/text.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/factory.h"
#include "stackabilization/structure/project_file.h"

namespace stackabilization::apps {

namespace {

/// The project of MODEL, current where the session goes on. A mesh gives what its project file would hold,
/// so that the file makes the same designs again.
Project project_of(const SuggestCommandOptions& options, const StructuredModel& input) {
  Project project{input.structured, input.history, input.space};
  if (!is_project(input.model.name))
    project.rest = project_of_text(project_text(input.structured), display_name(input.model));
  if (options.roll_back) {
    if (project.history.nodes.empty())
      throw UsageError("--roll-back goes back in the history of a project file, and " +
                       display_name(input.model) + " has none yet");
    project.history = roll_back(std::move(project.history), *options.roll_back);
  }
  return project;
}

Direction direction_of(const SuggestCommandOptions& options, const History& history) {
  if (options.direction) return Direction(*options.direction);
  if (history.nodes.empty()) return {0, 0, 1};
  return Direction(history.nodes[static_cast<std::size_t>(history.current)].direction);
}

/// The model that made the history; where there is none yet, the one that is asked for.
void choose_model(const SuggestCommandOptions& options, SuggestRun& run) {
  DeformationModelOptions& space = run.project.space;
  if (run.project.history.nodes.empty())
    space = {options.kind.value_or(DeformationKind::controllers),
             run.direction,
             {},
             options.family == EditFamily::smooth ? Following::smooth : Following::free};
  else if (options.kind && *options.kind != space.kind)
    throw UsageError("--model " + name_of(*options.kind) + " does not fit the history, which was made with " +
                     name_of(space.kind));
}

void apply_suggestion(SuggestRun& run, int number) {
  const std::size_t possible = run.possible();
  if (number < 1 || static_cast<std::size_t>(number) > possible)
    throw UsageError("--apply expects the number of a suggestion that can be made, up to " +
                     std::to_string(possible) + ", found " + std::to_string(number));
  run.applied = number - 1;
  const Suggestion& chosen = run.suggestions[static_cast<std::size_t>(*run.applied)];
  HistoryNode node;
  node.edits = {chosen.edit.edit};
  node.constraints = run.constraints;
  node.name = describe(chosen.edit.reason, run.project.rest.shape.part_names);
  node.direction = run.direction.vector();
  node.stackability = chosen.measured.value;
  node.energy = chosen.energy.value;
  run.project.history = apply(std::move(run.project.history), std::move(node));
}

}  // namespace

std::optional<std::string> SuggestCommandOptions::destination() const {
  if (save) return save;
  if (!apply && !roll_back) return std::nullopt;
  if (!is_project(common.model))
    throw UsageError("--apply and --roll-back need --save with a project file to write: MODEL is a mesh");
  return common.model;
}

std::size_t SuggestRun::possible() const {
  return static_cast<std::size_t>(
      std::count_if(suggestions.begin(), suggestions.end(),
                    [](const Suggestion& suggestion) { return !suggestion.refusal.has_value(); }));
}

SuggestRun run_suggest(const SuggestCommandOptions& options, const StructuredModel& input) {
  SuggestRun run;
  run.project = project_of(options, input);
  History& history = run.project.history;
  run.direction = direction_of(options, history);
  choose_model(options, run);
  const StructuredShape& rest = run.project.rest;
  run.space = named(input.model, [&] { return deformation_model(rest, run.project.space); });
  Requirements requirements =
      requirements_of(options.requirements, rest.shape, options.measure,
                      options.family == EditFamily::smooth ? QualityDefault::limited : QualityDefault::any);
  requirements.target = options.target.value_or(0);
  const auto checker = named(input.model, [&] { return RequirementChecker(*run.space, requirements); });
  const auto measured = [&](const Design& design, const SuggestionOptions& how) {
    return named(input.model, [&] { return situation(checker, design, run.direction, how); });
  };
  run.constraints = deformation_constraints(requirements, rest, run.direction);
  SuggestionOptions suggesting;
  suggesting.alpha = options.alpha.value_or(suggesting.alpha);
  run.alpha = suggesting.alpha;
  suggesting.edits.family = options.family;
  suggesting.edits.bends = options.bends;
  if (history.nodes.empty()) {
    run.design = run.space->at_rest();
    run.now = measured(run.design, suggesting);
    HistoryNode root;
    root.name = "at rest";
    root.direction = run.direction.vector();
    root.stackability = run.now.measured.value;
    history.nodes.push_back(std::move(root));
  } else {
    run.design = named(input.model, [&] { return design_at(*run.space, history, history.current); });
    run.now = measured(run.design, suggesting);
  }
  run.node = history.current;
  const bool only_back = options.roll_back && !options.apply;
  if (!options.show_history && !only_back)
    run.suggestions = suggestions(checker, run.design, run.direction, suggesting);
  if (options.apply) apply_suggestion(run, *options.apply);
  return run;
}

}  // namespace stackabilization::apps
