#include "apps/stack/stack_run.h"

#include <utility>

#include "stackabilization/core/tolerances.h"
#include "stackabilization/stacking/stack_search.h"

namespace stackabilization::apps {

namespace {

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

}  // namespace

StackRun run_stack(const StackCommandOptions& options, const Model& model) {
  const Direction direction = options.stacking_direction();
  StackRun run;
  run.options = stack_options(options, model.shape.unit);
  run.period = options.period.value_or(1);
  run.extent = HullSupport(model.shape).extent(direction);
  if (options.within) {
    Wish wish;
    wish.length = options.within->in(model.shape.unit);
    StackabilityOptions measure = options.stackability;
    measure.clearance = run.options.clearance;
    measure.play = run.options.play;
    wish.plan = plan_stack(stackability(model.shape, direction, measure),
                           {run.options.copies, wish.length, run.options.clearance});
    run.wish = wish;
  }
  if (options.best_twist)
    fill_searched_twist(run, model, direction);
  else if (run.period > 1)
    fill_searched_period(run, model, direction);
  else
    run.result = stack_copies(model.shape, direction, run.options);
  if (run.wish) run.wish->met = run.result.height <= run.wish->length * (1 + tolerance::relative);
  return run;
}

}  // namespace stackabilization::apps
