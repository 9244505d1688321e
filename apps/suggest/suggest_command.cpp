#include <memory>

#include "apps/common/command.h"
#include "apps/common/output.h"
#include "apps/common/rendering.h"
#include "apps/common/values.h"
#include "apps/suggest/suggest_run.h"

namespace stackabilization::apps {

namespace {

void check_suggest_options(const SuggestCommandOptions& options) {
  check(options.requirements);
  CommandFiles files{{}, analysis_inputs(options.analysis)};
  const bool updates = !options.save && options.destination();
  files.outputs = {{updates ? "MODEL" : "--save", options.destination(), OutputKind::project, updates}};
  if (options.pictures) files.folder = {"--pictures", suggestion_folder(*options.pictures)};
  check_outputs(options.common, files);
  if (options.pictures) require_rendering();
  if (options.show_history && (options.apply || options.roll_back || options.pictures))
    throw UsageError(
        "--history only prints what was tried, so it goes with no --apply, --roll-back or "
        "--pictures");
  if (options.all && options.apply)
    throw UsageError("--all shows what cannot be applied, so it does not go with --apply");
}

std::string printed_text(const SuggestCommandOptions& options, const SuggestRun& run, const Model& model) {
  if (options.destination() == "-") return "";
  if (options.show_history) return history_text(run.project);
  if (options.roll_back && !options.apply) return options.common.quiet ? "" : history_text(run.project);
  return options.common.quiet ? essential_suggestions(run, options) : suggestions_text(run, options, model);
}

int run_suggest_command(const CLI::App& command, const SuggestCommandOptions& options) {
  const Stopwatch watch;
  check_suggest_options(options);
  const ThreadLimit limit(options.common);
  const StructuredModel input = load_structured(command, options.common, options.analysis, bounds_of_designs);
  const SuggestRun result = run_suggest(options, input);

  Json document = document_head(command, input.model);
  add_suggestions(document, result, options);
  add_document_tail(document, options.common, input.model, watch);
  if (options.pictures) write_suggestion_pictures(result, options, input.model);
  if (const auto destination = options.destination())
    write_text_output(options.common, *destination, project_text(result.project));
  deliver(options.common, document, printed_text(options, result, input.model));
  const bool asked = !options.show_history && (!options.roll_back || options.apply);
  return asked && result.possible() == 0 ? status_no : status_done;
}

void add_wishes(CLI::App& command, SuggestCommandOptions& options) {
  add_direction(command, "--direction", options.direction,
                "Direction along which copies are stacked (default: that of the current node, else 0 0 1)");
  add_semantics_option(command, options.measure.semantics);
  add_boxes_option(command, options.measure.boxes);
  add_choice(command, "--model", options.kind, deformation_choices(),
             "What moves the mesh (default: that of the history, else controllers)");
  const Choices<EditFamily> families = {
      {"paper", EditFamily::paper}, {"extended", EditFamily::extended}, {"smooth", EditFamily::smooth}};
  add_choice(command, "--edits", options.family, families,
             "Which edits contacts suggest: those of the paper, or further ones too (default: extended)");
  command.add_flag("--bend", options.bends,
                   "Let straight parts bend and walls bulge, as in the paper (default: they stay straight)");
  add_number(command, alpha_option(), options.alpha);
  add_number(command, target_option("Say which suggestions reach this stackability"), options.target);
  add_requirement_options(command, options.requirements);
}

void add_session(CLI::App& command, SuggestCommandOptions& options) {
  constexpr std::uint64_t most = 1'000'000;
  add_count(command, {"--top", "Suggestions to show (default: 12)", 1, most}, options.top);
  command.add_flag("--all", options.all, "Show all of them, and those that are refused with the reason");
  add_count(command, {"--apply", "Take the suggestion of this number, and write the project", 1, most},
            options.apply);
  add_count(command, {"--roll-back", "Make this node of the history current, and write the project", 0, most},
            options.roll_back);
  command.add_flag("--history", options.show_history, "Print the tree of what was tried");
  command
      .add_option("--save", options.save,
                  "Write the project file there (default: MODEL, when that is a project that changes)")
      ->type_name("PROJECT");
  command
      .add_option("--pictures", options.pictures,
                  "Draw all that is shown on a sheet, and each suggestion before and after, into this folder")
      ->type_name("FOLDER");
}

}  // namespace

Command make_suggest_command(CLI::App& program) {
  const auto options = std::make_shared<SuggestCommandOptions>();
  CLI::App* const command =
      add_command(program, "suggest", "List the edits of one step that would make a shape stack better",
                  "stackabilize suggest chair.obj --save chair.json\n"
                  "  stackabilize suggest chair.json --apply 1\n"
                  "  stackabilize suggest chair.json --roll-back 0\n\n"
                  "Exit status 1: no edit can be made.");
  add_common_options(*command, options->common);
  add_analysis_options(*command, options->analysis);
  add_wishes(*command, *options);
  add_session(*command, *options);
  return {command, [command, options] { return run_suggest_command(*command, *options); }, &options->common};
}

}  // namespace stackabilization::apps
