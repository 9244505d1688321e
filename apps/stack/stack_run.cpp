#include "apps/stack/stack_run.h"

#include <algorithm>
#include <utility>

#include "apps/common/progress.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/stacking/separators.h"
#include "stackabilization/stacking/stack_search.h"
#include "stackabilization/stacking/tolerances.h"

namespace stackabilization::apps {

namespace {

/// Default of --max-shift, fraction of the longer side of the box across the direction.
constexpr double default_shift = 0.25;

void fill_searched_twist(StackRun& run, const Model& model, const Direction& direction) {
  TwistOptions search;
  search.stack = run.options;
  TwistResult found = best_twist(model.shape, direction, search);
  run.options.twist_degrees = found.twist_degrees;
  run.untwisted_stackability = found.untwisted_stackability;
  run.result = std::move(found.stack);
}

void fill_searched_period(StackRun& run, const Model& model, const Direction& direction) {
  PeriodOptions search;
  search.stack = run.options;
  search.period = run.period;
  PeriodResult found = best_period_stack(model.shape, direction, search);
  run.poses = std::move(found.poses);
  run.result = std::move(found.stack);
}

void fill_searched_step(StackRun& run, const StackCommandOptions& options, const Model& model) {
  const Direction direction = options.stacking_direction();
  const Frame frame = frame_of(direction);
  StepOptions search;
  search.stack = run.options;
  search.turn = options.turn;
  search.accuracy = tolerance::place_height * run.extent;
  search.max_shift = options.max_shift ? options.max_shift->in(model.shape.unit)
                                       : default_shift * std::max(range_along(model.shape, frame.u).length(),
                                                                  range_along(model.shape, frame.v).length());
  run.step = with_progress("Placing", options.common.caller, search, [&](const StepOptions& shown) {
    return best_step_stack(model.shape, direction, shown);
  });
  run.result = std::move(run.step->stack);
}

/// What the wish takes of a straight stack of `run.options.copies`.
Wish wish_of(const StackCommandOptions& options, const Model& model, const StackRun& run) {
  const Direction direction = options.stacking_direction();
  StackabilityOptions measure = options.stackability;
  measure.play = run.options.play;
  double gap = run.options.clearance;
  if (run.options.layer > 0) {
    StackOptions one = run.options;
    one.copies = 1;
    gap = stack_copies(model.shape, direction, one).increment -
          stackability(model.shape, direction, measure).f_max;
  }
  measure.clearance = gap;
  Wish wish;
  wish.length = options.within->in(model.shape.unit);
  wish.plan =
      plan_stack(stackability(model.shape, direction, measure), {run.options.copies, wish.length, gap});
  return wish;
}

}  // namespace

StackRun run_stack(const StackCommandOptions& options, const Model& model) {
  const Direction direction = options.stacking_direction();
  StackRun run;
  run.options = stack_options(options, model.shape.unit);
  run.period = options.period.value_or(1);
  run.extent = HullSupport(model.shape).extent(direction);
  if (options.within) run.wish = wish_of(options, model, run);
  if (run.wish && options.as_many_as_fit) {
    const std::int64_t fitting = run.wish->plan.copies_now.value_or(max_copies);
    run.options.copies = static_cast<int>(std::clamp<std::int64_t>(fitting, 1, max_copies));
    run.wish = wish_of(options, model, run);
  }
  if (options.best_twist)
    fill_searched_twist(run, model, direction);
  else if (options.best_place)
    fill_searched_step(run, options, model);
  else if (run.period > 1)
    fill_searched_period(run, model, direction);
  else
    run.result = stack_copies(model.shape, direction, run.options);
  if (options.separators)
    run.separators =
        separators(model.shape, direction, {run.options.semantics, run.result.increment, run.options.layer});
  if (run.wish) run.wish->met = run.result.height <= run.wish->length * (1 + tolerance::relative);
  return run;
}

}  // namespace stackabilization::apps
