#include "stackabilization/stacking/plan.h"

#include <cmath>
#include <limits>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization {

double stackability_within(const Stackability& measured, int copies, double length) {
  return measured.value_at((length - measured.extent) / (copies - 1));
}

StackPlan plan_stack(const Stackability& measured, const StackRequest& wish) {
  if (wish.copies < 1) throw UsageError("a plan needs at least one copy");
  if (!std::isfinite(wish.length) || wish.length <= 0)
    throw UsageError("the room for a stack must be a finite positive length");
  if (!std::isfinite(wish.clearance) || wish.clearance < 0)
    throw UsageError("the clearance must be a finite length of at least 0");

  const double room = wish.length - measured.extent, slack = tolerance::relative * wish.length;
  const double pitch = measured.f_max;
  const int gaps = wish.copies - 1;
  StackPlan plan;
  plan.length_now = measured.stack_height(wish.copies);
  plan.met = plan.length_now <= wish.length + slack;
  plan.possible = room >= gaps * wish.clearance - slack;
  if (gaps > 0) {
    plan.translation = room / gaps;
    plan.f_max = *plan.translation - wish.clearance;
    plan.stackability = stackability_within(measured, wish.copies, wish.length);
  }
  if (room < -slack) {
    plan.copies_now = 0;
  } else if (pitch > 0) {
    const double further = std::floor((room + slack) / pitch);
    constexpr auto most = std::numeric_limits<std::int64_t>::max();
    if (further < static_cast<double>(most)) plan.copies_now = 1 + static_cast<std::int64_t>(further);
  }
  return plan;
}

}  // namespace stackabilization
