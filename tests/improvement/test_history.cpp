#include "stackabilization/improvement/history.h"

#include <cmath>
#include <limits>

#include "deformation/structures.h"
#include "stackabilization/shape/errors.h"
#include "stackabilization/structure/project_file.h"
#include "support/catch.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

HistoryNode node_of(std::vector<Edit> edits) {
  HistoryNode node;
  node.edits = std::move(edits);
  node.constraints.keep_extent = Direction(0, 0, 1);
  return node;
}

/// The root and a child that widens the legs of a table, then two other children of the root.
History small_history() {
  History history;
  history.nodes.push_back({});
  history = apply(history, node_of({{{HandleKind::part, 1, 0}, Scale{0.9, Eigen::Vector3d(1, 0, 0)}, {}}}));
  history = apply(history, node_of({{{HandleKind::part, 1, 0}, Scale{1.1, Eigen::Vector3d(0, 1, 0)}, {}}}));
  history = roll_back(history, 0);
  return apply(history, node_of({{{HandleKind::face, 0, 4}, Scale{1.05, {}}, {}}}));
}

/// As a file holds it: numbers of primitives are rounded once.
StructuredShape rest_of_file() {
  return project_of_text(project_text(structures::table()), "table");
}

/// A history with every kind of entry, numbers that need all their digits among them.
Project rich_project() {
  Project project{rest_of_file(), small_history(), {DeformationKind::surface, Direction(0.1, -0.0, 1)}};
  HistoryNode node;
  node.name = "an \"odd\" n\u00e4me\n";
  node.direction = {1.0 / 3, -2e-17, 5e-300};
  node.stackability = -0.1;
  node.energy = std::nextafter(0.3, 1);
  node.constraints.keep_extent = Direction(0.3, 1.0 / 7, -1);
  node.constraints.box_tolerance = 0.1 + 0.2;
  node.constraints.fixed_parts = {4, 0};
  node.constraints.fixed_points = {{1e-5, 2, 3}, {0, -0.0, 1.0 / 3}};
  node.edits = {{{HandleKind::part, 2, 0}, Move{{0.1, -0.0, 1e59}}, {}},
                {{HandleKind::section, 3, 7}, Scale{1.0 / 3, {}}, Falloff::linear},
                {{HandleKind::corner, 0, 7}, Move{{1, 2, 3}}, {}},
                {{HandleKind::point, 0, 5}, Move{{1, 2, 3}}, {}},
                {{HandleKind::wire, 0, 12345}, Rotate{{0, 1, 1.0 / 3}, -std::sqrt(2)}, {}},
                {{HandleKind::shape, 0, 0}, Scale{2, Eigen::Vector3d(0, 1, 1e-9)}, {}}};
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
  const auto &scale = std::get<Scale>(a.operation), &other = std::get<Scale>(b.operation);
  return scale.factor == other.factor && scale.along == other.along;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.rfind(from);
  INFO("looking for " << from << " in\n" << text.substr(text.find("history")));
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

std::string refusal(const std::string& text) {
  try {
    project_with_history(text, "p.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

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

TEST_CASE("a history comes back from its file with every number, and is written again as the same text") {
  const Project project = rich_project();
  const std::string text = project_text(project);
  const Project back = project_with_history(text, "p.json");
  CHECK(project_text(back) == text);
  CHECK(back.space.kind == DeformationKind::surface);
  CHECK(back.space.direction.vector() == project.space.direction.vector());
  CHECK(back.history.current == project.history.current);
  REQUIRE(back.history.nodes.size() == project.history.nodes.size());
  for (std::size_t k = 0; k < back.history.nodes.size(); ++k) {
    const HistoryNode &is = back.history.nodes[k], &was = project.history.nodes[k];
    CHECK(is.parent == was.parent);
    CHECK(is.name == was.name);
    CHECK(is.direction == was.direction);
    CHECK(is.stackability == was.stackability);
    CHECK(is.energy == was.energy);
    CHECK(is.constraints.keep_extent.has_value() == was.constraints.keep_extent.has_value());
    CHECK(is.constraints.box_tolerance == was.constraints.box_tolerance);
    CHECK(is.constraints.fixed_parts == was.constraints.fixed_parts);
    CHECK(is.constraints.fixed_points == was.constraints.fixed_points);
    REQUIRE(is.edits.size() == was.edits.size());
    for (std::size_t e = 0; e < is.edits.size(); ++e) CHECK(same(is.edits[e], was.edits[e]));
  }
  const auto& constraints = back.history.nodes.back().constraints;
  CHECK(constraints.keep_extent->vector() == Eigen::Vector3d(0.3, 1.0 / 7, -1));
  CHECK(std::signbit(std::get<Move>(back.history.nodes.back().edits[0].operation).by.y()));
}

TEST_CASE("a project without a history stays what it was, and readers of the shape pass over one") {
  const Project project{rest_of_file(), {}, {}};
  CHECK(project_text(project) == project_text(project.rest));
  CHECK(project_with_history(project_text(project), "p").history.nodes.empty());
  const std::string text = project_text(rich_project());
  CHECK(text.size() > project_text(project).size());
  CHECK(project_text(project_of_text(text, "p")) == project_text(project));
  CHECK(project_contents(text, "p").sections.history.has_value());
  CHECK(!project_contents(project_text(project), "p").sections.history.has_value());
}

TEST_CASE("nodes are made again to the bit, from the file as from memory, whatever lies beside them") {
  const Project project{rest_of_file(), small_history(), {}};
  const auto space = design_space(project.rest, project.space);
  const Project back = project_with_history(project_text(project), "p");
  const auto other_space = design_space(back.rest, back.space);
  for (int node = 0; node < 4; ++node) {
    const Design design = design_at(*space, project.history, node);
    CHECK(design.shape.vertices == design_at(*other_space, back.history, node).shape.vertices);
    CHECK(design.edits.size() == edits_to(project.history, node).size());
    DeformationConstraints constraints;
    constraints.keep_extent = Direction(0, 0, 1);
    const DesignOutcome replayed = space->replayed(edits_to(project.history, node), constraints);
    REQUIRE(!replayed.refusal);
    CHECK(replayed.design.shape.vertices == design.shape.vertices);
    if (node > 0) CHECK(design.shape.vertices != project.rest.shape.vertices);
  }
}

TEST_CASE("each node keeps the constraints under which it was made") {
  const auto space = design_space(rest_of_file());
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
  const auto space = design_space(rest_of_file());
  History history;
  history.nodes.push_back({});
  const auto message = [&](const Edit& edit) -> std::string {
    try {
      design_at(*space, apply(history, node_of({edit})), 1);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  CHECK(message({{HandleKind::part, 0, 0}, Move{{1, 0, 0}}, {}}).find("node 1 of the history") == 0);
  CHECK(message({{HandleKind::wire, 0, 3}, Move{{1, 0, 0}}, {}}).find("node 1 of the history") == 0);
  CHECK_THROWS_AS(design_at(*space, history, 1), UsageError);
}

TEST_CASE("histories that could not be read again are not written") {
  const auto refused = [](const auto& change) {
    Project project = rich_project();
    change(project.history.nodes.back());
    CHECK_THROWS_AS(project_text(project), InputError);
  };
  refused([](HistoryNode& node) { node.parent = 4; });
  refused([](HistoryNode& node) { node.stackability = std::nan(""); });
  refused([](HistoryNode& node) { node.energy = infinite; });
  refused([](HistoryNode& node) { node.direction.setZero(); });
  refused([](HistoryNode& node) { node.name = "\xff"; });
  refused([](HistoryNode& node) { node.edits[0].handle.part = 99; });
  refused([](HistoryNode& node) { node.edits[0].handle.part = -1; });
  refused([](HistoryNode& node) { node.edits[3].handle.index = -1; });
  refused([](HistoryNode& node) { node.edits[0].operation = Move{{0, infinite, 0}}; });
  refused([](HistoryNode& node) { node.edits[0].operation = Scale{0, {}}; });
  refused([](HistoryNode& node) { node.constraints.fixed_parts.push_back(77); });
  refused([](HistoryNode& node) { node.constraints.box_tolerance = -1; });
  Project project = rich_project();
  project.history.current = 5;
  CHECK_THROWS_AS(project_text(project), InputError);
  project = rich_project();
  project.history.nodes.front().parent = 0;
  CHECK_THROWS_AS(project_text(project), InputError);
}

TEST_CASE("a broken history is refused at its place, in words") {
  struct Damage {
    std::string from, to, message;
  };
  Project controllers = rich_project();
  controllers.space = {};
  controllers.history.nodes.pop_back();
  controllers.history.current = 3;
  const std::string text = project_text(controllers);
  const std::vector<Damage> damages = {
      {"\"history\"", "\"histories\"", "there is no key 'histories' here, did you mean 'history'?"},
      {"\"current\": 3", "\"current\": 4", "/history/current: expected an integer from 0 to 3, found 4"},
      {"\"current\": 3", "\"current\": null", "/history/current: expected an integer"},
      {"\"controllers\"", "\"clay\"", "/history/model: expected 'controllers', 'surface', 'iwires' or"},
      {"{\"parent\":-1", "{\"parent\":0", "/history/nodes/0/parent: expected an integer from -1 to -1"},
      {"{\"parent\":1", "{\"parent\":2", "/history/nodes/2/parent: expected an integer from 0 to 1, found 2"},
      {"{\"parent\":1", "{\"parent\":-1", "/history/nodes/2/parent: expected an integer from 0 to 1"},
      {"\"part\":\"top\"", "\"part\":\"tip\"", "/history/nodes/3/edits/0/handle/part: expected"},
      {"\"kind\":\"face\"", "\"kind\":\"fate\"", "/history/nodes/3/edits/0/handle/kind: expected"},
      {"\"kind\":\"face\"", "\"kind\":\"section\"", "part 'top' is a cuboid"},
      {"\"kind\":\"face\"", "\"kind\":\"wire\"", "/handle: there is no key 'part' here"},
      {"\"kind\":\"face\"", "\"kind\":\"part\"", "/handle: there is no key 'index' here"},
      {"\"index\":4", "\"index\":6", "/handle/index: expected an integer from 0 to 5, found 6"},
      {"\"factor\":1.05", "\"factor\":-1", "/history/nodes/3/edits/0: a scaling needs a positive factor"},
      {"\"factor\":1.05", "\"factor\":1e999", "beyond the range of double"},
      {"\"factor\":1.05", "\"factor\":\"big\"", "/scale/factor: expected a number"},
      {"\"scale\":", "\"move\":[0,0,0],\"scale\":", "expected one of the keys 'move', 'rotate' and 'scale'"},
      {"\"scale\":", "\"shove\":", "there is no key 'shove' here"},
      {"\"keep_extent\":[0.0,0.0,1.0]", "\"keep_extent\":[0,0,0]", "expected a direction that is not zero"},
      {"\"energy\":0.0", "\"energy\":null", "/history/nodes/3/energy: expected a number, found null"},
      {"\"energy\":0.0", "\"energy\":0.0,\"energy\":1", "the key 'energy' occurs twice"},
      {"\"energy\":0.0,", "", "the key 'energy' is missing"},
  };
  for (const Damage& damage : damages) {
    const std::string message = refusal(replaced(text, damage.from, damage.to));
    INFO(damage.from << " -> " << damage.to << ": " << message);
    CHECK(message.find("p.json") == 0);
    CHECK(message.find(damage.message) != std::string::npos);
  }
  const std::string plain = project_text(controllers.rest);
  for (const std::string history : {"null", "[]", "{}", "3", "{\"nodes\": []}"})
    CHECK(refusal(replaced(plain, "}\n", ", \"history\": " + history + "}\n")).find("p.json: /history: ") ==
          0);
  CHECK(refusal(replaced(plain, "}\n", ", \"history\": " + std::string(100, '[') + "}\n")) != "accepted");
}

TEST_CASE("any cut and any flipped byte of a history is read or refused, never worse") {
  const std::string text = project_text(rich_project());
  const std::size_t start = text.find("\"history\"");
  solids::Random random(91);
  int refused = 0;
  for (int round = 0; round < 600; ++round) {
    std::string damaged = text;
    const std::size_t at = start + random.below(text.size() - start);
    if (round % 3 == 0)
      damaged.resize(at);
    else
      damaged[at] = static_cast<char>(random.below(256));
    const std::string message = refusal(damaged);
    refused += message != "accepted";
    if (message == "accepted") {
      const std::string again = project_text(project_with_history(damaged, "again"));
      CHECK(project_text(project_with_history(again, "once more")) == again);
    }
  }
  CHECK(refused > 300);
}
