#include "improvement/search/search_state.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <variant>

#include "io/formats/json_node.h"
#include "stackabilization/core/errors.h"

namespace stackabilization::detail {

namespace {

using nlohmann::json;

constexpr std::string_view format_name = "stackabilization search";
constexpr int format_version = 2;
constexpr std::int64_t max_count = std::numeric_limits<std::int64_t>::max();

const std::vector<std::string> state_names = {"queued", "expanded", "solution", "repeated"};
const std::vector<std::string> handle_names = {"part", "face", "corner", "section", "point", "wire", "shape"};

json json_of(const Eigen::Vector3d& vector) {
  return json::array({vector.x(), vector.y(), vector.z()});
}

Eigen::Vector3d vector_of(const JsonNode& node) {
  node.expect_size(3);
  return {node[0].finite(), node[1].finite(), node[2].finite()};
}

Eigen::Vector3d direction_of(const JsonNode& node) {
  const Eigen::Vector3d vector = vector_of(node);
  try {
    return Direction(vector).vector();
  } catch (const UsageError& error) {
    node.fail(error.what());
  }
}

/// Reads 64 bits from a text: JSON numbers of that size are not safe everywhere.
std::uint64_t word_of(const JsonNode& node) {
  const std::string text = node.text();
  std::uint64_t word = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), word);
  if (error != std::errc() || end != text.data() + text.size())
    node.fail_expected("a whole number in quotes");
  return word;
}

int row_of(const JsonNode& node, int low, int high) {
  return static_cast<int>(node.integer(low, high));
}

json json_of(const Edit& edit) {
  json text;
  text["handle"] = {handle_names[static_cast<std::size_t>(edit.handle.kind)], edit.handle.part,
                    edit.handle.index};
  if (edit.falloff == Falloff::linear) text["falloff"] = "linear";
  if (const auto* move = std::get_if<Move>(&edit.operation)) text["move"] = json_of(move->by);
  if (const auto* turn = std::get_if<Rotate>(&edit.operation)) {
    text["axis"] = json_of(turn->axis);
    text["radians"] = turn->radians;
  }
  if (const auto* scale = std::get_if<Scale>(&edit.operation)) {
    text["factor"] = scale->factor;
    if (scale->along) text["along"] = json_of(*scale->along);
  }
  return text;
}

Edit edit_of(const JsonNode& node) {
  constexpr int largest = std::numeric_limits<int>::max();
  node.expect_keys({"handle", "falloff", "move", "axis", "radians", "factor", "along"}, 6);
  Edit edit;
  node["handle"].expect_size(3);
  edit.handle = {static_cast<HandleKind>(node["handle"][0].one_of(handle_names)),
                 row_of(node["handle"][1], 0, largest), row_of(node["handle"][2], 0, largest)};
  if (node.has("falloff")) edit.falloff = Falloff::linear;
  if (node.has("move")) {
    edit.operation = Move{vector_of(node["move"])};
  } else if (node.has("axis")) {
    node.expect_keys({"handle", "axis", "radians", "falloff"}, 1);
    edit.operation = Rotate{vector_of(node["axis"]), node["radians"].finite()};
  } else {
    node.expect_keys({"handle", "factor", "falloff", "along"}, 2);
    Scale scale{node["factor"].finite(), std::nullopt};
    if (node.has("along")) scale.along = vector_of(node["along"]);
    edit.operation = scale;
  }
  try {
    validate(edit);
  } catch (const UsageError& error) {
    node.fail(error.what());
  }
  return edit;
}

json json_of(const SearchNode& node) {
  const Stackability& at = node.measured;
  const Distortion& change = node.energy.distortion;
  json text = {{"parent", node.parent},
               {"queue", node.queue},
               {"state", state_names[static_cast<std::size_t>(node.state)]},
               {"direction", json_of(node.direction)},
               {"measured", {at.f_max, at.extent, at.box_volume, at.base, at.value}},
               {"distortion", {change.volume, change.proximity, change.box, change.symmetry}},
               {"energy", {node.energy.gain, node.energy.value}},
               {"key", std::to_string(node.key)}};
  if (node.parent < 0) return text;
  text["edit"] = json_of(node.edit);
  text["why"] = node.why;
  return text;
}

/// What a candidate of a saved search is checked against.
struct Expected {
  int queues = 0;
  const std::vector<Handle>& handles;
};

void read_measures(const JsonNode& node, SearchNode& result) {
  const JsonNode at = node["measured"], change = node["distortion"], energy = node["energy"];
  at.expect_size(5);
  change.expect_size(4);
  energy.expect_size(2);
  result.measured = {result.direction, at[0].finite(), at[1].finite(),
                     at[2].finite(),   at[3].finite(), at[4].finite()};
  result.energy.distortion = {change[0].finite(), change[1].finite(), change[2].finite(), change[3].finite()};
  result.energy.gain = energy[0].finite();
  result.energy.value = energy[1].finite();
}

/// Reads candidate `id`. The roots come first, one per queue; every other candidate comes after its parent.
SearchNode node_of(const JsonNode& node, int id, const Expected& expected) {
  node.expect_keys(
      {"parent", "queue", "state", "direction", "measured", "distortion", "energy", "key", "edit", "why"}, 2);
  const bool is_root = id < expected.queues;
  SearchNode result;
  result.parent = row_of(node["parent"], is_root ? -1 : 0, is_root ? -1 : id - 1);
  result.queue = row_of(node["queue"], is_root ? id : 0, is_root ? id : expected.queues - 1);
  result.state = static_cast<NodeState>(node["state"].one_of(state_names));
  result.direction = direction_of(node["direction"]);
  read_measures(node, result);
  result.key = word_of(node["key"]);
  if (is_root) return result;
  if (!node.has("edit") || !node.has("why")) node.fail("the key 'edit' or 'why' is missing");
  result.edit = edit_of(node["edit"]);
  if (std::find(expected.handles.begin(), expected.handles.end(), result.edit.handle) ==
      expected.handles.end())
    node["edit"]["handle"].fail("expected something that can be edited in this shape");
  result.why = node["why"].text();
  return result;
}

std::vector<Eigen::Vector3d> directions_at(const JsonNode& node) {
  std::vector<Eigen::Vector3d> directions;
  for (std::size_t k = 0; k < node.list_size(); ++k) directions.push_back(direction_of(node[k]));
  if (directions.empty()) node.fail_expected("at least one direction");
  return directions;
}

/// Returns the root of the document. Fails unless it has this format and version.
JsonNode checked_root(const nlohmann::ordered_json& document, const std::string& name) {
  JsonNode root(document, name);
  if (!document.is_object() || !root.has("format") || document.at("format") != std::string(format_name) ||
      !root.has("version") || document.at("version") != format_version)
    root.fail("this is no saved search of this version of the program");
  root.expect_keys({"format", "version", "task", "directions", "turn", "expanded", "evaluated", "trials",
                    "refusals", "candidates"});
  return root;
}

std::map<std::string, std::int64_t> refusals_of(const nlohmann::ordered_json& document,
                                                const JsonNode& node) {
  std::map<std::string, std::int64_t> refusals;
  if (!document.is_object()) node.fail_expected("an object");
  for (const auto& [reason, count] : document.items()) refusals[reason] = node[reason].integer(0, max_count);
  return refusals;
}

SearchState state_of(const SavedSearch& saved, const SearchTask& task) {
  const nlohmann::ordered_json document = parse_json(saved.text, saved.name);
  const JsonNode root = checked_root(document, saved.name);
  SearchState state(task.fingerprint, task.directions);
  if (word_of(root["task"]) != state.task || directions_at(root["directions"]) != task.directions)
    root.fail("the saved search belongs to another shape, other requirements or other options");
  const Expected expected{static_cast<int>(task.directions.size()), task.handles};
  const JsonNode candidates = root["candidates"];
  if (candidates.list_size() < task.directions.size())
    candidates.fail_expected("a candidate for each direction");
  for (std::size_t id = 0; id < candidates.list_size(); ++id)
    state.tree.add(node_of(candidates[id], static_cast<int>(id), expected));
  state.tree.set_turn(row_of(root["turn"], 0, expected.queues - 1));
  state.refusals = refusals_of(document.at("refusals"), root["refusals"]);
  state.expanded = root["expanded"].integer(0, max_count);
  state.evaluated = root["evaluated"].integer(0, max_count);
  state.trials = root["trials"].integer(0, max_count);
  return state;
}

/// Calls `read` and turns its InputError into SavedSearchError.
template <class Read>
auto as_saved_search(const Read& read) {
  try {
    return read();
  } catch (const InputError& error) {
    throw SavedSearchError(error.what());
  }
}

}  // namespace

SearchTask search_task(const RequirementChecker& checker, const BestFirstOptions& options) {
  return {task_fingerprint(checker, options), options.directions, checker.space().handles()};
}

std::string text_of(const SearchState& state) {
  json candidates = json::array(), directions = json::array();
  for (const SearchNode& node : state.tree.nodes()) candidates.push_back(json_of(node));
  for (const Eigen::Vector3d& direction : state.directions) directions.push_back(json_of(direction));
  const json text = {{"format", format_name},
                     {"version", format_version},
                     {"task", std::to_string(state.task)},
                     {"directions", std::move(directions)},
                     {"turn", state.tree.turn()},
                     {"expanded", state.expanded},
                     {"evaluated", state.evaluated},
                     {"trials", state.trials},
                     {"refusals", state.refusals},
                     {"candidates", std::move(candidates)}};
  return text.dump(-1, ' ', false, json::error_handler_t::replace);
}

SearchState read_state(const SavedSearch& saved, const SearchTask& task) {
  return as_saved_search([&] { return state_of(saved, task); });
}

}  // namespace stackabilization::detail

namespace stackabilization {

bool is_search_state(const std::string& text) {
  using nlohmann::json;
  const json state = json::parse(text, nullptr, false);
  return state.is_object() && state.value("format", json()) == std::string(detail::format_name);
}

std::vector<Eigen::Vector3d> directions_of(const SavedSearch& state) {
  return detail::as_saved_search([&] {
    const nlohmann::ordered_json document = detail::parse_json(state.text, state.name);
    return detail::directions_at(detail::checked_root(document, state.name)["directions"]);
  });
}

}  // namespace stackabilization
