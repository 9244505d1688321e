#include <memory>

#include "apps/common/caller.h"
#include "apps/common/command.h"
#include "apps/common/output.h"
#include "apps/common/rendering.h"
#include "apps/stack/stack_run.h"

namespace stackabilization::apps {

namespace {

/// Ten turns: more is a typing error.
constexpr double max_twist_degrees = 3600;

/// Copies in their places, one shape each.
PlacedCopies placed_copies(const StackRun& run, const Model& model, const Direction& direction) {
  PlacedCopies stack;
  stack.direction = direction;
  stack.notes = stack_notes(run, model.shape.unit, direction);
  for (const StackedCopy& copy : run.result.copies) {
    const RigidTransform lift{Eigen::Matrix3d::Identity(), copy.offset.to_double() * direction.vector()};
    stack.copies.push_back(transformed(model.shape, composed(lift, copy.transform)));
    if (static_cast<int>(stack.separators.size()) < run.gap_count())
      stack.separators.push_back(transformed(*run.separators, composed(lift, copy.transform)));
  }
  return stack;
}

/// The copies, and after each of them the separators above it.
Copies copies_to_write(const StackRun& run, const Model& model, const Direction& direction) {
  const Copies stacked = stacked_copies(model.shape, direction, run.result);
  if (run.gap_count() == 0 || run.separators->triangle_count() == 0) return stacked;
  Copies all{{model.shape, *run.separators}, {}};
  for (std::size_t k = 0; k < stacked.placed.size(); ++k) {
    const PlacedCopy& copy = stacked.placed[k];
    all.placed.push_back(copy);
    if (k + 1 < stacked.placed.size())
      all.placed.push_back({"separator" + std::to_string(k + 1), copy.rotation, copy.translation, 1});
  }
  return all;
}

int run_stack_command(const CLI::App& command, const StackCommandOptions& options) {
  check(options);
  if (options.into) return run_nest(command, options);
  const Stopwatch watch;
  const Direction direction = options.stacking_direction();
  const ThreadLimit limit(options.common);
  const Model model = load_model(options.common);
  const StackRun stack = named(model, [&] { return run_stack(options, model); });
  check_drawn(options, stack.options.copies);

  Json document = document_head(command, model);
  add_stack(document, stack, direction);
  add_document_tail(document, options.common, model, watch);
  if (stack.gap_count() > 0 && stack.separators->triangle_count() > 0 && options.common.caller)
    options.common.caller->written_meshes["separators"] = *stack.separators;
  if (options.output)
    write_mesh_output(options.common, *options.output, copies_to_write(stack, model, direction));
  if (options.picture)
    write_stack_picture({*options.picture, title_of(model)}, placed_copies(stack, model, direction));
  deliver(options.common, document,
          options.common.quiet ? exact_digits(stack.result.stackability) + "\n"
                               : stack_text(stack, model, direction));
  return stack.wish && !stack.wish->met ? status_no : status_done;
}

void add_twist_option(CLI::App& command, StackCommandOptions& options) {
  const Number angle = {"--twist-degrees",
                        "Turn each copy by this angle about the direction; auto finds the best",
                        -max_twist_degrees, max_twist_degrees};
  const auto take = [angle, &options](const std::string& text) {
    options.best_twist = text == "auto";
    if (!options.best_twist) options.twist_degrees = parse_number(angle, text);
  };
  command.add_option_function<std::string>(angle.name, take, angle.description)->type_name("A|auto");
}

void add_step_options(CLI::App& command, StackCommandOptions& options) {
  const Choices<bool> places = {{"given", false}, {"best", true}};
  add_choice(command, "--place", options.best_place, places,
             "best: shift each copy against the one below so that it comes to rest lowest "
             "(default: given, straight on top of it)");
  command.add_flag("--turn", options.turn, "With --place best, copies may turn about the direction, too");
  add_length(command,
             {"--max-shift", "Largest shift of --place best (default: a quarter of the longer side)"},
             options.max_shift);
}

void add_copies_option(CLI::App& command, StackCommandOptions& options) {
  const Count count = {"-n", "Number of copies, or max: as many as --within holds (default: 2)", 1,
                       max_copies};
  const auto take = [count, &options](const std::string& text) {
    options.as_many_as_fit = text == "max";
    if (!options.as_many_as_fit) options.copies = static_cast<int>(parse_count(count, text));
  };
  command.add_option_function<std::string>(count.name, take, count.description)->type_name("N|max");
}

}  // namespace

Command make_stack_command(CLI::App& program) {
  const auto options = std::make_shared<StackCommandOptions>();
  CLI::App* const command =
      add_command(program, "stack", "Stack copies of a shape, or put it into another one",
                  "stackabilize stack chair.obj -n 10 --unit m --within 2m -o stack.3mf");
  add_common_options(*command, options->common);
  add_copies_option(*command, *options);
  command->add_option("--into", options->into, "Lower MODEL into this container instead of stacking copies")
      ->type_name("CONTAINER");
  add_direction(*command, "--direction", options->direction, "Stacking direction (default: 0 0 1)");
  add_semantics_option(*command, options->stackability.semantics);
  add_boxes_option(*command, options->stackability.boxes);
  add_twist_option(*command, *options);
  add_count(*command, {"--period", "Turn or flip copies in a cycle of this length, the best one found", 1, 5},
            options->period);
  add_step_options(*command, *options);
  add_length(*command, {"--clearance", "Air between copies along the direction, as 0.5 or 2mm"},
             options->clearance);
  add_length(*command, {"--lateral-clearance", "Sideways play that every contact allows"},
             options->lateral_clearance);
  add_length(*command, {"--layer", "Lift copies by whole layers of a print, this thick", true},
             options->layer);
  command->add_flag("--separators", options->separators,
                    "Fill the gaps where they are narrow with bodies of their own, for another material");
  add_length(*command, {"--within", "Room along the direction: exit status 1 if the stack is higher", true},
             options->within);
  add_mesh_output(*command, options->common, options->output, "the stack");
  command->add_option("--picture", options->picture, "Draw the stack (.png or .svg)")->type_name("FILE");
  return {command, [command, options] { return run_stack_command(*command, *options); }, &options->common};
}

}  // namespace stackabilization::apps
