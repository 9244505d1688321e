#include "support/histories.h"

#include <cmath>

#include "stackabilization/structure/project_file.h"
#include "support/structures.h"

namespace stackabilization::histories {

HistoryNode node_of(std::vector<Edit> edits) {
  HistoryNode node;
  node.edits = std::move(edits);
  node.constraints.keep_extent = Direction(0, 0, 1);
  return node;
}

History small_history() {
  History history;
  history.nodes.push_back({});
  history = apply(history, node_of({{{HandleKind::part, 1, 0}, Scale{0.9, Eigen::Vector3d(1, 0, 0)}, {}}}));
  history = apply(history, node_of({{{HandleKind::part, 1, 0}, Scale{1.1, Eigen::Vector3d(0, 1, 0)}, {}}}));
  history = roll_back(history, 0);
  return apply(history, node_of({{{HandleKind::face, 0, 4}, Scale{1.05, {}}, {}}}));
}

StructuredShape rest_of_file() {
  return project_of_text(project_text(structures::table()), "table");
}

Project rich_project() {
  Project project{rest_of_file(), small_history(), {DeformationKind::surface, Direction(0.1, -0.0, 1)}};
  HistoryNode node;
  node.name = "an \"odd\" n\u00e4me\n";
  node.direction = {1.0 / 3, -2e-17, 5e-300};
  node.stackability = -0.1;
  node.energy = std::nextafter(0.3, 1);
  node.constraints.keep_extent = Direction(0.3, 1.0 / 7, -1);
  node.constraints.extent_ends = ExtentEnds::fixed;
  node.constraints.box_tolerance = 0.1 + 0.2;
  node.constraints.fixed_parts = {4, 0};
  node.constraints.fixed_points = {{1e-5, 2, 3}, {0, -0.0, 1.0 / 3}};
  node.edits = {{{HandleKind::part, 2, 0}, Move{{0.1, -0.0, 1.5e-7}}, {}},
                {{HandleKind::section, 3, 7}, Scale{1.0 / 3, {}}, Falloff::linear},
                {{HandleKind::corner, 0, 7}, Move{{1, 2, 3}}, {}},
                {{HandleKind::point, 0, 5}, Move{{1, 2, 3}}, {}},
                {{HandleKind::wire, 0, 12345}, Rotate{{0, 1, 1.0 / 3}, -std::sqrt(2)}, {}},
                {{HandleKind::shape, 0, 0}, Scale{2, Eigen::Vector3d(0, 1, 1e-9)}, {}},
                {{HandleKind::shape, 0, 0}, Taper{1.0 / 3, {0, 1e-9, -2}, Eigen::Vector3d(1, 0, 0)}, {}},
                {{HandleKind::part, 1, 0}, Lean{{1.0 / 3, 0, 0}, {0, 1e-9, -2}}, {}}};
  project.history = apply(project.history, node);
  return project;
}

bool same(const Edit& a, const Edit& b) {
  if (!(a.handle == b.handle) || a.falloff != b.falloff || a.operation.index() != b.operation.index())
    return false;
  if (const auto* move = std::get_if<Move>(&a.operation)) return move->by == std::get<Move>(b.operation).by;
  if (const auto* turn = std::get_if<Rotate>(&a.operation)) {
    const auto& other = std::get<Rotate>(b.operation);
    return turn->axis == other.axis && turn->radians == other.radians;
  }
  if (const auto* taper = std::get_if<Taper>(&a.operation)) {
    const auto& other = std::get<Taper>(b.operation);
    return taper->factor == other.factor && taper->axis == other.axis && taper->along == other.along;
  }
  if (const auto* lean = std::get_if<Lean>(&a.operation)) {
    const auto& other = std::get<Lean>(b.operation);
    return lean->by == other.by && lean->axis == other.axis;
  }
  const auto &scale = std::get<Scale>(a.operation), &other = std::get<Scale>(b.operation);
  return scale.factor == other.factor && scale.along == other.along;
}

}  // namespace stackabilization::histories
