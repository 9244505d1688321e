#include "apps/stack/stack_options.h"

#include "apps/common/output.h"
#include "apps/common/rendering.h"

namespace stackabilization::apps {

namespace {

constexpr int max_drawn_copies = 200;

}  // namespace

void check_drawn(const StackCommandOptions& options, int copies) {
  refuse_option(options.picture && copies > max_drawn_copies, "--picture", "draws at most 200 copies");
}

void check(const StackCommandOptions& options) {
  std::vector<InputFile> container;
  if (options.into) container.push_back({"the container", *options.into});
  check_outputs(options.common, {{{"--output", options.output, OutputKind::mesh},
                                  {"--picture", options.picture, OutputKind::picture}},
                                 container});
  if (options.picture) require_rendering();
  check_drawn(options, options.copy_count());
  refuse_option(options.best_twist && options.period, "--twist-degrees auto",
                "cannot be combined with --period");
  const bool twisted = options.twist_degrees || options.best_twist || options.period;
  const bool turned = twisted || options.best_place;
  refuse_option(options.best_place && twisted, "--place best",
                "cannot be combined with --twist-degrees or --period");
  refuse_option(options.turn && !options.best_place, "--turn", "needs --place best");
  refuse_option(options.max_shift && !options.best_place, "--max-shift", "needs --place best");
  refuse_option(options.as_many_as_fit && !options.within, "-n max", "needs the room of --within");
  refuse_option(options.as_many_as_fit && turned, "-n max", "is for copies straight on top of each other");
  refuse_option(options.layer && turned, "--layer",
                "is for copies straight on top of each other: others are not sliced alike");
  refuse_option(options.separators && !options.layer, "--separators", "needs the thickness of a --layer");
  refuse_option(options.separators && !options.clearance, "--separators", "needs a --clearance to fill");
  if (!options.into) return;
  const char* const reason = "makes no sense with --into, which puts one MODEL into one container";
  refuse_option(options.copies.has_value() || options.as_many_as_fit, "-n", reason);
  refuse_option(options.twist_degrees || options.best_twist, "--twist-degrees", reason);
  refuse_option(options.period.has_value(), "--period", reason);
  refuse_option(options.within.has_value(), "--within", reason);
  refuse_option(options.layer.has_value(), "--layer", reason);
  refuse_option(options.best_place, "--place best", reason);
  refuse_option(options.common.model == "-" && *options.into == "-", "--into",
                "and MODEL cannot both be standard input");
}

Play play_of(const StackCommandOptions& options, Unit unit) {
  return {length_in(options.clearance, unit), length_in(options.lateral_clearance, unit)};
}

StackOptions stack_options(const StackCommandOptions& options, Unit unit) {
  const Play play = play_of(options, unit);
  StackOptions stack;
  stack.copies = options.copy_count();
  stack.semantics = options.stackability.semantics;
  stack.boxes = options.stackability.boxes;
  stack.twist_degrees = options.twist_degrees.value_or(0);
  stack.clearance = play.clearance;
  stack.play = play.lateral;
  stack.layer = length_in(options.layer, unit);
  return stack;
}

}  // namespace stackabilization::apps
