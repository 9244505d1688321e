#include <memory>

#include "apps/common/command.h"
#include "apps/common/output.h"
#include "apps/common/rendering.h"
#include "apps/common/values.h"
#include "apps/deform/deform_run.h"
#include "stackabilization/deformation/rebase.h"
#include "stackabilization/structure/project_file.h"

namespace stackabilization::apps {

namespace {

void check_deform_options(const DeformCommandOptions& options) {
  check_outputs(options.common, {{{"--output", options.output, OutputKind::mesh},
                                  {"--picture", options.picture, OutputKind::picture},
                                  {"--save", options.save, OutputKind::project}},
                                 analysis_inputs(options.analysis)});
  if (options.picture) require_rendering();
  if (options.edits.empty() && !options.list_handles)
    throw UsageError("expected --edit with what to do, or --list-handles");
  if (!options.edits.empty() && options.list_handles)
    throw UsageError("--list-handles changes nothing, so it does not go with --edit");
  if (options.list_handles && (options.output || options.picture || options.save))
    throw UsageError("--list-handles changes nothing, so there is nothing to write");
  if (options.direction && !capabilities_of(options.kind).edits_along_one_direction)
    throw UsageError("--direction is that of --model gap-scaling: the others have none");
  if (options.extent_ends && !options.keep_extent)
    throw UsageError("--extent-ends says where the extent of --keep-extent begins and ends: give that too");
  if (options.save && !capabilities_of(options.kind).edits_primitives)
    throw UsageError("--save needs --model controllers: the others move no primitives");
  if (options.following && options.kind != DeformationKind::controllers)
    throw UsageError("--follow is of --model controllers: the others have no parts that follow");
}

int list_handles(const CLI::App& command, const DeformCommandOptions& options, const Stopwatch& watch) {
  const StructuredModel input = load_structured(command, options.common, options.analysis, bounds_of_deform);
  const auto model = model_for_edits(options, input.structured);
  Json document = document_head(command, input.model);
  document["deformation"] = name_of(options.kind);
  document["handles"] = handles_json(*model, input.structured.shape);
  add_document_tail(document, options.common, input.model, watch);
  deliver(options.common, document, handles_text(*model, input.structured.shape));
  return status_done;
}

void write_result(const DeformCommandOptions& options, const DeformRun& run, const Model& model) {
  if (options.output) write_mesh_output(options.common, *options.output, run.result.design.shape);
  if (options.save)
    write_text_output(options.common, *options.save, project_text(rebase(run.rest, run.result.design)));
  if (options.picture)
    write_deformation_picture({*options.picture, title_of(model)},
                              {run.rest, run.result.design, run.edits, run.curves, deformation_notes(run)});
}

int run_deform_command(const CLI::App& command, const DeformCommandOptions& options) {
  const Stopwatch watch;
  check_deform_options(options);
  const ThreadLimit limit(options.common);
  if (options.list_handles) return list_handles(command, options, watch);
  const StructuredModel input = load_structured(command, options.common, options.analysis, bounds_of_deform);
  const DeformRun run = run_deform(options, input);
  const bool refused = run.result.refusal.has_value();

  Json document = document_head(command, input.model);
  add_deformation(document, run);
  add_document_tail(document, options.common, input.model, watch);
  if (!refused) write_result(options, run, input.model);
  const std::string essential =
      refused ? "refused\n"
              : exact_digits(displacement(run.rest.shape, run.result.design.shape).root_mean_square) + "\n";
  deliver(options.common, document,
          options.save == "-"    ? ""
          : options.common.quiet ? essential
                                 : deformation_text(run, input.model));
  return refused ? status_no : status_done;
}

void add_constraint_options(CLI::App& command, DeformCommandOptions& options) {
  add_direction(command, "--keep-extent", options.keep_extent,
                "Keep the extent along this direction exactly");
  const Choices<ExtentEnds> ends = {{"free", ExtentEnds::free}, {"fixed", ExtentEnds::fixed}};
  add_choice(command, "--extent-ends", options.extent_ends, ends,
             "... wherever it lies then, or where it lies at rest, as designs of improve (default: free)");
  add_fraction(command, "--box-tolerance", options.box_tolerance,
               "Fraction by which the sides of the box along x, y and z may change, as 0.05 or 5%");
  command.add_option("--fix", options.fixed_parts, "Part that stays as it is; repeatable")
      ->type_size(1)
      ->allow_extra_args(false)
      ->type_name("PART");
  add_points(command, "--fix-point", options.fixed_points, "Point of the surface that stays; repeatable");
}

}  // namespace

Command make_deform_command(CLI::App& program) {
  const auto options = std::make_shared<DeformCommandOptions>();
  CLI::App* const command = add_command(
      program, "deform", "Edit a shape so that its symmetries and joints stay",
      "stackabilize deform chair.json --edit \"seat scale 1.1 along 1 0 0\" -o wider.obj\n\n"
      "An edit is a handle (PART, PART/face=-z, PART/corner=0, PART/section=3, point=7, wire=2, shape)\n"
      "and move X Y Z, rotate DEGREES about X Y Z, or scale FACTOR [along X Y Z]; of cross-sections also\n"
      "move X Y Z linearly, scale FACTOR linearly; of parts also lean X Y Z towards X Y Z; of the shape\n"
      "also taper FACTOR towards X Y Z [along X Y Z].");
  add_common_options(*command, options->common);
  add_analysis_options(*command, options->analysis);
  command
      ->add_option("--edit", options->edits,
                   "What to do, \"HANDLE OPERATION NUMBERS\"; repeatable, made in order")
      ->type_size(1)
      ->allow_extra_args(false)
      ->type_name("EDIT");
  add_choice(*command, "--model", options->kind, deformation_choices(),
             "What moves the mesh (default: controllers)");
  const Choices<Following> ways = {{"free", Following::free}, {"smooth", Following::smooth}};
  add_choice(*command, "--follow", options->following, ways,
             "How other parts follow with --model controllers: any way, or by affine maps, with joints that "
             "slide, as in "
             "the designs of improve (default: free)");
  add_direction(*command, "--direction", options->direction,
                "Direction of --model gap-scaling, along which the gap is scaled (default: 0 0 1)");
  add_constraint_options(*command, *options);
  command->add_flag("--list-handles", options->list_handles,
                    "Print everything that can be edited, with its centre");
  add_mesh_output(*command, options->common, options->output, "the shape");
  command->add_option("--save", options->save, "Write the result as a project file")->type_name("PROJECT");
  command->add_option("--picture", options->picture, "Draw the shape before and after (.png or .svg)")
      ->type_name("FILE");
  return {command, [command, options] { return run_deform_command(*command, *options); }, &options->common};
}

}  // namespace stackabilization::apps
