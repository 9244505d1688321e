#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/common/json.h"
#include "apps/common/model.h"
#include "apps/stack/stack_options.h"
#include "stackabilization/stacking/plan.h"
#include "stackabilization/stacking/stack.h"
#include "stackabilization/stacking/stack_step.h"

namespace stackabilization::apps {

/// A wish such as "10 chairs within 2 m", and the answer.
struct Wish {
  double length = 0;  ///< model units
  bool met = false;   ///< by the stack as asked for, twist and period included
  StackPlan plan;     ///< for a straight stack
};

/// A stack of copies, however it was found.
struct StackRun {
  StackOptions options;
  StackResult result;
  double extent = 0;                             ///< of one copy along the direction, model units
  std::optional<double> untwisted_stackability;  ///< for comparison when the twist was searched
  int period = 1;
  std::vector<std::string> poses;  ///< per copy of a period, when it was searched
  std::optional<Wish> wish;
  std::optional<StepResult> step;  ///< what --place best found, but for its stack
  /// Bodies in the gap above a copy, in its coordinates; only where asked for.
  std::optional<Shape> separators;

  /// Returns how many copies have separators above them.
  int gap_count() const { return separators ? options.copies - 1 : 0; }
};

StackRun run_stack(const StackCommandOptions& options, const Model& model);

void add_stack(Json& document, const StackRun& run, const Direction& direction);
std::string stack_text(const StackRun& run, const Model& model, const Direction& direction);
/// Lines for a picture of the stack.
std::vector<std::string> stack_notes(const StackRun& run, Unit unit, const Direction& direction);

/// The subcommand with --into: MODEL is lowered into a container.
int run_nest(const CLI::App& command, const StackCommandOptions& options);

}  // namespace stackabilization::apps
