#include "common/asked_design.h"

#include <tuple>
#include <utility>

#include "common/clock.h"
#include "stackabilization/improvement/shape_change.h"
#include "stackabilization/improvement/task.h"

namespace stackabilization::experiments {

namespace {

std::pair<std::string, double> tightest(const Assessment& assessment, const QualityLimits& limits) {
  std::pair<std::string, double> result{"", 0};
  for (const Check& check : assessment.checks) {
    if (check.kind != CheckKind::quality) continue;
    const double share = share_of_limit({check.measure, check.value}, limits);
    if (share > result.second) result = {name_of(check.measure), share};
  }
  return result;
}

}  // namespace

std::string AskedDesign::why(const Structure& structure) const {
  if (!found.diagnosis || found.diagnosis->blockers.empty()) return "";
  return describe(found.diagnosis->blockers.front(), structure);
}

std::string AskedDesign::remedy(const Structure& structure) const {
  if (!found.diagnosis || found.diagnosis->remedies.empty()) return "";
  return describe(found.diagnosis->remedies.front(), structure);
}

AskedDesign ask_for_design(const StructuredShape& model, const Direction& direction, double target,
                           double effort) {
  Requirements requirements;
  requirements.quality.emplace();
  requirements.target = target;
  ImprovementTaskOptions how;
  how.directions = {direction.vector()};
  how.effort = effort;
  const ImprovementTask task(model, requirements, how);
  ImprovementOptions options = improvement_options(task);
  options.effort = effort;
  AskedDesign result;
  const double start = now();
  options.found = [&](const Candidate&) {
    if (result.first_seconds == 0) result.first_seconds = now() - start;
  };
  result.found = improve(task, options);
  result.seconds = now() - start;
  result.best = result.found.before;
  if (result.found.nearest) result.best = *result.found.nearest;
  if (result.reached()) result.best = result.found.solutions.front();
  std::tie(result.measure, result.share_of_limit) = tightest(
      task.checker().check(result.best.design, Direction(result.best.direction)), *requirements.quality);
  result.change = shape_change(model.shape, result.best.design.shape).root_mean_square;
  return result;
}

}  // namespace stackabilization::experiments
