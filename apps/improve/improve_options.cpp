#include "apps/improve/improve_options.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "apps/common/text.h"
#include "apps/improve/improve_files.h"
#include "stackabilization/improvement/front.h"

namespace stackabilization::apps {

namespace {

constexpr double max_seconds = 1e9;  ///< some thirty years
constexpr double max_effort = 1e6;   ///< about a year
constexpr int max_solutions = 20;

void check_wish(const ImproveCommandOptions& options) {
  check(options.room, options.target);
  if (!options.target && !options.room.copies && !options.front)
    throw UsageError("expected --target S, or --copies N with --within LENGTH");
  refuse_option(options.room.copies && options.directions.size() > 1, "--direction",
                "is given once with --copies and --within: the room is along it");
}

/// A front is made of refined designs for several targets, each by a run of its own.
void check_front(const ImproveCommandOptions& options) {
  if (!options.front) return;
  refuse_option(options.room.copies.has_value(), "--copies", "does not go with --front, which goes by S");
  refuse_option(options.preset == ImprovementPreset::paper, "--preset paper",
                "does not go with --front, whose designs are refined");
  refuse_option(options.seconds.has_value(), "--time", "does not go with --front: --effort bounds its work");
  refuse_option(options.resume, "--resume", "does not go with --front, whose runs are not saved");
}

/// The gaps are measured once, along one direction.
void check_gap_scaling(const ImproveCommandOptions& options) {
  if (!capabilities_of(options.kind).edits_along_one_direction) return;
  refuse_option(options.cone_degrees && *options.cone_degrees > 0, "--cone-degrees",
                "does not go with --model gap-scaling, which keeps the direction that it scales along");
  refuse_option(options.directions.size() > 1, "--direction",
                "is given once with --model gap-scaling, which scales along it");
}

void add_wish_options(CLI::App& command, ImproveCommandOptions& options) {
  add_number(command, target_option("Stackability to be reached, below 1"), options.target);
  add_room_options(command, options.room);
  add_directions(
      command, "--direction", options.directions,
      "Direction to stack along; repeatable, the first is preferred (default: 0 0 1, then the best "
      "one found)");
  add_semantics_option(command, options.measure.semantics);
  add_boxes_option(command, options.measure.boxes);
}

void add_search_options(CLI::App& command, ImproveCommandOptions& options) {
  add_count(command,
            {"--solutions",
             "Different solutions to look for (default: 3); with --front, designs beside that at rest "
             "(default: 8)",
             1, max_solutions},
            options.solutions);
  command.add_flag("--front", options.front,
                   "Show the trade of S against change: designs from rest to --target, or to the largest S "
                   "that is reached, with a curve");
  add_choice(command, "--model", options.kind, deformation_choices(),
             "What moves the mesh (default: controllers)");
  const Choices<ImprovementPreset> presets = {{"paper", ImprovementPreset::paper},
                                              {"refined", ImprovementPreset::refined}};
  add_choice(command, "--preset", options.preset, presets,
             "paper: search in the paper's steps; refined: then least change of continuous magnitudes "
             "(default: refined)");
  const Choices<ChangeMeasure> measures = {{"distortion", ChangeMeasure::distortion},
                                           {"displacement", ChangeMeasure::displacement},
                                           {"both", ChangeMeasure::both}};
  add_choice(
      command, "--least", options.objective, measures,
      "What refinement makes small: the distortion D of the primitives, the displacement of the vertices "
      "(root mean square), or the sum of both (default: both)");
  add_number(
      command,
      {"--effort", "How much work to do at most: 1 takes up to about 40 seconds on two cores (default: 1)", 0,
       max_effort, true},
      options.effort);
  add_number(command,
             {"--time", "Seconds after which to end with the best so far (default: no such limit)", 0,
              max_seconds, true},
             options.seconds);
  add_count(command, {"--expansions", "Candidates to expand at most (default: 100)", 1}, options.expansions);
  add_number(command, alpha_option(), options.alpha);
  command.add_flag("--bend", options.bends,
                   "Let straight parts bend and walls bulge, as in the paper (default: they stay straight)");
  add_number(command,
             {"--cone-degrees",
              "The direction may turn by this angle at each edit, 0: never (default: 0 with --direction, "
              "--copies or --model gap-scaling, else 10)",
              0, max_degrees},
             options.cone_degrees);
}

}  // namespace

void add_improve_options(CLI::App& command, ImproveCommandOptions& options) {
  add_common_options(command, options.common);
  add_wish_options(command, options);
  add_search_options(command, options);
  add_requirement_options(command, options.requirements);
  add_parts(command, "--remove", options.removed, "Part to leave out of the design first; repeatable");
  add_analysis_options(command, options.analysis);
  command.add_flag("--twist", options.twist,
                   "Report too how well copies stack that are turned against each other");
  command.add_flag("--no-pictures", options.no_pictures, "Leave the pictures out: quicker");
  command.add_flag("--resume", options.resume, "Go on with the search that was stopped in the folder");
  command.add_option("-o,--output", options.folder, "Folder for solutions, pictures and the page index.html")
      ->type_name("FOLDER")
      ->required();
}

void check(const ImproveCommandOptions& options) {
  check_wish(options);
  check_front(options);
  check_gap_scaling(options);
  check(options.requirements);
  check_outputs(options.common,
                {{}, analysis_inputs(options.analysis), {{"--output", improve_folder(options)}}});
}

std::optional<double> ImproveCommandOptions::wanted_target() const {
  return target || !front ? target : farthest_target;
}

double effort_of(const ImproveCommandOptions& options) {
  return options.effort.value_or(options.front ? front_effort : ImprovementOptions().effort);
}

ImprovementOptions improvement_options_of(const ImproveCommandOptions& options, const ImprovementTask& task) {
  ImprovementOptions improvement = improvement_options(task);
  improvement.preset = options.preset;
  BestFirstOptions& search = improvement.search;
  search.alpha = options.alpha.value_or(search.alpha);
  improvement.refinement.alpha = search.alpha;
  improvement.refinement.objective = options.objective;
  if (options.preset == ImprovementPreset::paper) search.edits.family = EditFamily::paper;
  search.edits.bends = options.bends;
  search.edits.contacts.semantics = options.measure.semantics;
  search.solutions = options.wanted();
  search.expansions = options.expansions.value_or(search.expansions);
  improvement.effort = effort_of(options);
  search.cone_degrees = options.cone_degrees.value_or(search.cone_degrees);
  return improvement;
}

}  // namespace stackabilization::apps
