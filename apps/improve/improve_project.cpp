#include "apps/improve/improve_project.h"

#include <utility>

#include "stackabilization/core/tolerances.h"

namespace stackabilization::apps {

namespace {

HistoryNode root(const ImproveReport& report) {
  const ImproveTask& task = report.task;
  HistoryNode node;
  node.name = "at rest";
  node.direction = task.task->directions().front();
  node.stackability = task.checker().rest_shape().measure(Direction(node.direction)).value;
  return node;
}

HistoryNode node_of(const ImproveTask& task, const SolutionReport& solution) {
  HistoryNode node;
  node.parent = 0;
  node.edits = solution.candidate.design.edits;
  node.constraints =
      deformation_constraints(task.checker().requirements(), task.rest(), solution.direction());
  node.name = solution.name;
  node.direction = solution.candidate.direction;
  node.stackability = solution.assessment.measured.value;
  node.energy = solution.candidate.energy.value;
  return node;
}

bool makes_again(const ImproveTask& task, const HistoryNode& node, const Design& design) {
  const DeformationResult outcome = task.task->space().deformed(node.edits, node.constraints);
  if (outcome.refusal) return false;
  const double most = tolerance::relative * task.rest().structure.diagonal;
  return (outcome.design.shape.vertices - design.shape.vertices).cwiseAbs().maxCoeff() <= most;
}

}  // namespace

Project improvement_project(const ImproveReport& report) {
  const ImproveTask& task = report.task;
  Project project{task.rest(),
                  {},
                  {task.task->space().kind(),
                   Direction(task.task->directions().front()),
                   {},
                   task.task->space().following()}};
  project.history.nodes.push_back(root(report));
  for (const SolutionReport* solution : report.shown()) {
    HistoryNode node = node_of(task, *solution);
    if (!node.edits.empty() && makes_again(task, node, solution->candidate.design))
      project.history.nodes.push_back(std::move(node));
  }
  if (project.history.nodes.size() > 1) project.history.current = 1;
  return project;
}

}  // namespace stackabilization::apps
