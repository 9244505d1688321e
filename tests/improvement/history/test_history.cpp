#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/factory.h"
#include "stackabilization/improvement/history.h"
#include "support/catch.h"
#include "support/histories.h"
#include "support/messages.h"

using namespace stackabilization;
using namespace stackabilization::histories;

TEST_CASE("edits of a node are those of its ancestors, then its own") {
  const History history = small_history();
  REQUIRE(history.nodes.size() == 4);
  CHECK(history.current == 3);
  CHECK(history.nodes[1].parent == 0);
  CHECK(history.nodes[2].parent == 1);
  CHECK(history.nodes[3].parent == 0);
  CHECK(edits_to(history, 0).empty());
  const std::vector<Edit> edits = edits_to(history, 2);
  REQUIRE(edits.size() == 2);
  CHECK(same(edits[0], history.nodes[1].edits[0]));
  CHECK(same(edits[1], history.nodes[2].edits[0]));
  REQUIRE(edits_to(history, 3).size() == 1);
  CHECK(same(edits_to(history, 3)[0], history.nodes[3].edits[0]));
}

TEST_CASE("rolling back and applying leave the history that they are given, and old nodes, alone") {
  const History history = small_history();
  const History back = roll_back(history, 1);
  CHECK(history.current == 3);
  CHECK(back.current == 1);
  CHECK(back.nodes.size() == history.nodes.size());
  HistoryNode child = node_of({});
  child.parent = 99;  // what the caller says of it does not count
  const History more = apply(back, child);
  CHECK(back.nodes.size() == 4);
  REQUIRE(more.nodes.size() == 5);
  CHECK(more.current == 4);
  CHECK(more.nodes[4].parent == 1);
}

TEST_CASE("nodes that are not there and parents that are no ancestors are refused") {
  History history = small_history();
  for (const int node : {-1, 4, 99}) {
    CHECK_THROWS_AS(edits_to(history, node), UsageError);
    CHECK_THROWS_AS(roll_back(history, node), UsageError);
  }
  CHECK_THROWS_AS(apply(History{}, {}), UsageError);
  for (const int parent : {1, 2, 1000}) {
    history.nodes[1].parent = parent;
    CHECK_THROWS_AS(edits_to(history, 1), UsageError);
    CHECK_THROWS_AS(edits_to(history, 2), UsageError);
  }
}

TEST_CASE("nodes are made again to the bit, from the file as from memory, whatever lies beside them") {
  const Project project{rest_of_file(), small_history(), {}};
  const auto space = deformation_model(project.rest, project.space);
  const Project back = project_with_history(project_text(project), "p");
  const auto other_space = deformation_model(back.rest, back.space);
  for (int node = 0; node < 4; ++node) {
    const Design design = design_at(*space, project.history, node);
    CHECK(design.shape.vertices == design_at(*other_space, back.history, node).shape.vertices);
    CHECK(design.edits.size() == edits_to(project.history, node).size());
    DeformationConstraints constraints;
    constraints.keep_extent = Direction(0, 0, 1);
    const DeformationResult replayed = space->deformed(edits_to(project.history, node), constraints);
    REQUIRE(!replayed.refusal);
    CHECK(replayed.design.shape.vertices == design.shape.vertices);
    if (node > 0) CHECK(design.shape.vertices != project.rest.shape.vertices);
  }
}

TEST_CASE("each node keeps the constraints under which it was made") {
  const auto space = deformation_model(rest_of_file());
  HistoryNode node;
  node.edits = {{{HandleKind::part, 0, 0}, Scale{1.5, {}}, {}}};
  History history;
  history.nodes.push_back({});
  const auto height = [&](const Design& design) {
    return range_along(design.shape, Eigen::Vector3d::UnitZ()).length();
  };
  const double at_rest = height(space->at_rest());
  CHECK(height(design_at(*space, apply(history, node), 1)) > 1.01 * at_rest);
  node.constraints.keep_extent = Direction(0, 0, 1);
  CHECK(height(design_at(*space, apply(history, node), 1)) == Approx(at_rest).epsilon(1e-9));
}

TEST_CASE("nodes that cannot be made again are refused with their number") {
  const auto space = deformation_model(rest_of_file());
  History history;
  history.nodes.push_back({});
  const auto message = [&](const Edit& edit) {
    return message_of<InputError>([&] { design_at(*space, apply(history, node_of({edit})), 1); });
  };
  CHECK(message({{HandleKind::part, 0, 0}, Move{{1, 0, 0}}, {}}).find("node 1 of the history") == 0);
  CHECK(message({{HandleKind::wire, 0, 3}, Move{{1, 0, 0}}, {}}).find("node 1 of the history") == 0);
  CHECK_THROWS_AS(design_at(*space, history, 1), UsageError);
}
