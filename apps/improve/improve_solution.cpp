#include "apps/improve/improve_solution.h"

#include <algorithm>

#include "stackabilization/deformation/relation_residual.h"

namespace stackabilization::apps {

namespace {

StackHeights stack_heights(const ImproveCommandOptions& options, const ImproveTask& task,
                           const SolutionReport& report) {
  const int copies = options.shown_copies();
  return {copies, report.before.stack_height(copies), report.assessment.measured.stack_height(copies),
          task.length_limit()};
}

TwistResult twisted(const ImproveTask& task, const SolutionReport& report) {
  const Requirements& asked = task.checker().requirements();
  TwistOptions search;
  search.stack.copies = report.stack.copies;
  search.stack.semantics = asked.measure.semantics;
  search.stack.boxes = asked.measure.boxes;
  search.stack.clearance = asked.measure.clearance;
  search.stack.play = asked.measure.play;
  return best_twist(report.candidate.design.shape, report.direction(), search);
}

Holding holding(const ImproveTask& task, const SolutionReport& report) {
  const Requirements& asked = task.checker().requirements();
  HoldingOptions options;
  options.copies = std::max(2, report.stack.copies);
  options.friction = asked.friction.value_or(default_friction);
  options.semantics = asked.measure.semantics;
  return holding_of(report.candidate.design.shape, report.direction(), options);
}

}  // namespace

bool SolutionReport::confirmed() const {
  return std::none_of(written.begin(), written.end(),
                      [](const Confirmation& check) { return check.verdict == Verdict::disagrees; });
}

bool SolutionReport::good() const {
  return assessment.passed() && stack.fits() && confirmed();
}

SolutionReport solution_report(const ImproveCommandOptions& options, const ImproveTask& task,
                               const Candidate& candidate, const Assessment& assessment) {
  SolutionReport report;
  report.target = task.target();
  report.candidate = candidate;
  report.assessment = assessment;
  const Direction direction = report.direction();
  const StructuredShape& rest = task.rest();
  report.before = task.checker().rest_shape().measure(direction);
  report.change = shape_change(rest.shape, candidate.design.shape);
  report.explanation = explain(rest, candidate.design.shape,
                               {Eigen::Vector3d::UnitZ(), candidate.design.edits, candidate.reasons});
  report.residuals = relation_residuals(rest.structure, candidate.design.primitives);
  report.stack = stack_heights(options, task, report);
  if (options.twist) report.twist = twisted(task, report);
  if (assessment.separation.blocked) report.holding = holding(task, report);
  return report;
}

}  // namespace stackabilization::apps
