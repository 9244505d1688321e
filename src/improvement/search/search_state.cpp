#include "improvement/search/search_state.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <variant>

#include "improvement/design/edit_json.h"
#include "stackabilization/core/errors.h"

namespace stackabilization::detail {

namespace {

using json = nlohmann::ordered_json;

constexpr std::string_view format_name = "stackabilization search";
constexpr int format_version = 6;
constexpr std::int64_t max_count = std::numeric_limits<std::int64_t>::max();

const std::vector<std::string> state_names = {"queued", "expanded", "solution", "repeated"};
constexpr std::array axis_names = {"x", "y", "z"};

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

/// The numbers of a refusal that are rows and indices, in the order in which they are saved.
constexpr std::array rows_of_refusal = {&Refusal::part, &Refusal::relation, &Refusal::index, &Refusal::other,
                                        &Refusal::symmetry};

// Causes, checks and effects are saved as their numbers: whoever changes their order changes format_version.

json json_of(const Obstacle& obstacle, std::int64_t count) {
  if (const auto* check = std::get_if<Check>(&obstacle))
    return {{"count", count},
            {"check", static_cast<int>(check->kind)},
            {"measure", static_cast<int>(check->measure)}};
  const Refusal& refusal = std::get<Refusal>(obstacle);
  json text = {{"count", count}, {"cause", static_cast<int>(refusal.cause)}};
  for (const auto row : rows_of_refusal) text["rows"].push_back(refusal.*row);
  for (std::size_t k = 0; k < 3; ++k)
    if (refusal.axis[k] != Refusal::untold) text[axis_names[k]] = refusal.axis[k];
  return text;
}

Obstacle obstacle_of(const JsonNode& node, const Structure& rest) {
  if (node.has("check")) {
    node.expect_keys({"count", "check", "measure"});
    Check check{static_cast<CheckKind>(row_of(node["check"], 0, static_cast<int>(CheckKind::quality)))};
    check.measure =
        static_cast<QualityMeasure>(row_of(node["measure"], 0, static_cast<int>(quality_measure_count) - 1));
    return check;
  }
  node.expect_keys({"count", "cause", "rows", "x", "y", "z"}, 3);
  Refusal refusal;
  refusal.cause =
      static_cast<RefusalCause>(row_of(node["cause"], 0, static_cast<int>(RefusalCause::uneven_row)));
  node["rows"].expect_size(rows_of_refusal.size());
  for (std::size_t k = 0; k < rows_of_refusal.size(); ++k)
    refusal.*rows_of_refusal[k] = row_of(node["rows"][k], -1, std::numeric_limits<int>::max());
  for (std::size_t k = 0; k < 3; ++k)
    if (node.has(axis_names[k])) refusal.axis[k] = node[axis_names[k]].finite();
  try {
    describe(refusal, rest);
  } catch (const std::out_of_range&) {
    node["rows"].fail("expected parts and relations of this shape");
  }
  return refusal;
}

json json_of(const EditReason& reason) {
  return {static_cast<int>(reason.effect), reason.leaning, reason.away_from};
}

EditReason reason_of(const JsonNode& node, const StructuredShape& rest) {
  node.expect_size(3);
  return {static_cast<EditEffect>(row_of(node[0], 0, static_cast<int>(EditEffect::compensation))),
          node[1].boolean(), row_of(node[2], -1, static_cast<int>(rest.shape.part_count()) - 1)};
}

json json_of(const SearchNode& node, const std::vector<std::string>& part_names) {
  const Stackability& at = node.measured;
  const Distortion& change = node.energy.distortion;
  json text = {{"parent", node.parent},
               {"queue", node.queue},
               {"state", state_names[static_cast<std::size_t>(node.state)]},
               {"direction", to_json(node.direction)},
               {"measured", {at.f_max, at.extent, at.box_volume, at.base, at.value}},
               {"distortion", {change.volume, change.proximity, change.box, change.symmetry}},
               {"energy", {node.energy.gain, node.energy.value}},
               {"key", std::to_string(node.key)}};
  if (node.parent < 0) return text;
  text["edit"] = to_json(node.edit, part_names);
  text["reason"] = json_of(node.reason);
  return text;
}

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
SearchNode node_of(const JsonNode& node, int id, const SearchTask& task) {
  node.expect_keys(
      {"parent", "queue", "state", "direction", "measured", "distortion", "energy", "key", "edit", "reason"},
      2);
  const int queues = static_cast<int>(task.directions.size());
  const bool is_root = id < queues;
  SearchNode result;
  result.parent = row_of(node["parent"], is_root ? -1 : 0, is_root ? -1 : id - 1);
  result.queue = row_of(node["queue"], is_root ? id : 0, is_root ? id : queues - 1);
  result.state = static_cast<NodeState>(node["state"].one_of(state_names));
  result.direction = direction_from_json(node["direction"]);
  read_measures(node, result);
  result.key = word_of(node["key"]);
  if (is_root) return result;
  if (!node.has("edit") || !node.has("reason")) node.fail("the key 'edit' or 'reason' is missing");
  result.edit = edit_from_json(node["edit"], task.rest, task.capabilities);
  if (std::find(task.handles.begin(), task.handles.end(), result.edit.handle) == task.handles.end())
    node["edit"]["handle"].fail("expected something that can be edited in this shape");
  result.reason = reason_of(node["reason"], task.rest);
  return result;
}

std::vector<Eigen::Vector3d> directions_at(const JsonNode& node) {
  std::vector<Eigen::Vector3d> directions;
  for (std::size_t k = 0; k < node.list_size(); ++k) directions.push_back(direction_from_json(node[k]));
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

std::map<Obstacle, std::int64_t> refusals_of(const JsonNode& node, const Structure& rest) {
  std::map<Obstacle, std::int64_t> refusals;
  for (std::size_t k = 0; k < node.list_size(); ++k) {
    const Obstacle obstacle = obstacle_of(node[k], rest);
    refusals[obstacle] = node[k]["count"].integer(0, max_count);
  }
  return refusals;
}

SearchState state_of(const SavedSearch& saved, const SearchTask& task) {
  const nlohmann::ordered_json document = parse_json(saved.text, saved.name);
  const JsonNode root = checked_root(document, saved.name);
  SearchState state(task.fingerprint, task.directions);
  if (word_of(root["task"]) != state.task || directions_at(root["directions"]) != task.directions)
    root.fail("the saved search belongs to another shape, other requirements or other options");
  const JsonNode candidates = root["candidates"];
  if (candidates.list_size() < task.directions.size())
    candidates.fail_expected("a candidate for each direction");
  for (std::size_t id = 0; id < candidates.list_size(); ++id)
    state.tree.add(node_of(candidates[id], static_cast<int>(id), task));
  state.tree.set_turn(row_of(root["turn"], 0, static_cast<int>(task.directions.size()) - 1));
  state.refusals = refusals_of(root["refusals"], task.rest.structure);
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
  const DeformationModel& space = checker.space();
  return {task_fingerprint(checker, options), options.directions, space.handles(), space.rest(),
          space.capabilities()};
}

std::string text_of(const SearchState& state, const std::vector<std::string>& part_names) {
  json candidates = json::array(), directions = json::array(), refusals = json::array();
  for (const auto& [obstacle, count] : state.refusals) refusals.push_back(json_of(obstacle, count));
  for (const SearchNode& node : state.tree.nodes()) candidates.push_back(json_of(node, part_names));
  for (const Eigen::Vector3d& direction : state.directions) directions.push_back(to_json(direction));
  const json text = {{"format", format_name},
                     {"version", format_version},
                     {"task", std::to_string(state.task)},
                     {"directions", std::move(directions)},
                     {"turn", state.tree.turn()},
                     {"expanded", state.expanded},
                     {"evaluated", state.evaluated},
                     {"trials", state.trials},
                     {"refusals", std::move(refusals)},
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
