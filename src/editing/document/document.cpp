#include "stackabilization/editing/document.h"

#include <algorithm>
#include <cmath>

#include "stackabilization/structure/project_file.h"

namespace stackabilization::editing {

namespace {

/// Increase of S that is offered as a target, and the largest target that is offered.
constexpr double wanted_gain = 0.2, max_offered_target = 0.9;

double rounded_to_two_digits(double value) {
  return std::round(100 * value) / 100;
}

}  // namespace

Document new_document(StructuredShape rest, const StackabilityOptions& measure) {
  // What its project file holds: a file rounds some primitives once.
  Project project{.rest = project_of_text(project_text(rest), "the shape"), .history = {}, .space = {}};
  return document_of(std::move(project), measure);
}

Document document_of(Project project, const StackabilityOptions& measure) {
  Document document;
  if (project.history.nodes.empty()) {
    project.space.following = Following::smooth;
    HistoryNode root;
    root.name = "at rest";
    root.stackability = stackability(project.rest.shape, Direction(root.direction), measure).value;
    project.history.nodes.push_back(std::move(root));
  }
  document.requirements.measure = measure;
  document.requirements.quality.emplace();
  document.requirements.target = std::min(
      rounded_to_two_digits(project.history.nodes.front().stackability + wanted_gain), max_offered_target);
  document.visited = {project.history.current};
  document.project = std::move(project);
  return document;
}

}  // namespace stackabilization::editing
