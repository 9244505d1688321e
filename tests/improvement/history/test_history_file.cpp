#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "stackabilization/core/errors.h"
#include "stackabilization/structure/project_file.h"
#include "support/catch.h"
#include "support/histories.h"
#include "support/messages.h"
#include "support/variants.h"

using namespace stackabilization;
using namespace stackabilization::histories;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The last `from`.
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.rfind(from);
  INFO("looking for " << from << " in\n" << text.substr(std::min(text.size(), text.find("history"))));
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

std::string refusal(const std::string& text) {
  return message_of<InputError>([&] { project_with_history(text, "p.json"); });
}

}  // namespace

TEST_CASE("a history comes back from its file with every number, and is written again as the same text") {
  const Project project = rich_project();
  const std::string text = project_text(project);
  const Project back = project_with_history(text, "p.json");
  CHECK(project_text(back) == text);
  CHECK(back.space.kind == DeformationKind::surface);
  CHECK(back.space.direction->vector() == project.space.direction->vector());
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
    CHECK(is.constraints.extent_ends == was.constraints.extent_ends);
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

TEST_CASE("an edit by itself has the form that it has in a history") {
  const Project project = rich_project();
  const auto nodes = nlohmann::ordered_json::parse(project_text(project))["history"]["nodes"];
  for (std::size_t k = 0; k < project.history.nodes.size(); ++k) {
    const std::vector<Edit>& edits = project.history.nodes[k].edits;
    for (std::size_t e = 0; e < edits.size(); ++e)
      CHECK(edit_json(edits[e], project.rest.shape.part_names) == nodes[k]["edits"][e].dump());
  }
  CHECK_THROWS_AS(edit_json(project.history.nodes.back().edits[0], {}), InputError);
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
  refused([](HistoryNode& node) { node.name = std::string(1, static_cast<char>(0xff)); });
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
      {"\"factor\":1.05", "\"factor\":1e30",
       "/history/nodes/3/edits/0: a scaling needs a factor from 1e-06 to 1000000, found 1e+30"},
      {"\"scale\":{\"factor\":1.05}", "\"move\":[0,0,1e50]",
       "/history/nodes/3/edits/0: a move goes at most 1000 times the diagonal of the shape"},
      {"\"scale\":{\"factor\":1.05}", "\"rotate\":{\"axis\":[0,0,1e-200],\"radians\":1}",
       "/history/nodes/3/edits/0: a rotation needs an axis"},
      {"\"scale\":{\"factor\":1.05}", "\"rotate\":{\"axis\":[0,0,1],\"radians\":1e30}",
       "/history/nodes/3/edits/0: a rotation needs an angle from -3600 to 3600 degrees"},
      {"\"keep_extent\":", "\"fixed_points\":[[0,0,1e9]],\"keep_extent\":",
       "/history/nodes/3/constraints: a fixed point lies on the surface, or at most"},
      {"\"factor\":1.05", "\"factor\":1e999", "beyond the range of double"},
      {"\"factor\":1.05", "\"factor\":\"big\"", "/scale/factor: expected a number"},
      {"\"scale\":", "\"move\":[0,0,0],\"scale\":",
       "expected one of the keys 'move', 'rotate', 'scale', 'taper' and 'lean'"},
      {"\"scale\":", "\"shove\":", "there is no key 'shove' here"},
      {"\"keep_extent\":[0.0,0.0,1.0]", "\"keep_extent\":[0,0,0]", "a direction cannot be (0, 0, 0)"},
      {"\"keep_extent\":", "\"extent_ends\":\"loose\",\"keep_extent\":",
       "/constraints/extent_ends: expected 'free' or 'fixed', found 'loose'"},
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
