#include "stackabilization/improvement/search_state.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <variant>

#include "stackabilization/shape/errors.h"

namespace stackabilization::detail {

namespace {

using nlohmann::json;

constexpr std::string_view format_name = "stackabilization search";
constexpr int format_version = 1;

constexpr std::array<std::string_view, 4> state_names = {"queued", "expanded", "solution", "repeated"};
constexpr std::array<std::string_view, 7> handle_names = {"part",  "face", "corner", "section",
                                                          "point", "wire", "shape"};

template <std::size_t count>
int index_in(const std::array<std::string_view, count>& names, const std::string& name) {
  for (std::size_t k = 0; k < count; ++k)
    if (names[k] == name) return static_cast<int>(k);
  throw InputError("a saved search has something unknown: '" + name + "'");
}

json json_of(const Eigen::Vector3d& vector) {
  return json::array({vector.x(), vector.y(), vector.z()});
}

double finite(const json& value) {
  const double number = value.get<double>();
  if (!std::isfinite(number)) throw InputError("a saved search has a number out of range");
  return number;
}

Eigen::Vector3d vector_of(const json& value) {
  if (value.size() != 3) throw InputError("a saved search has a vector without three components");
  return {finite(value.at(0)), finite(value.at(1)), finite(value.at(2))};
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

Edit edit_of(const json& text) {
  Edit edit;
  const json& handle = text.at("handle");
  edit.handle = {static_cast<HandleKind>(index_in(handle_names, handle.at(0).get<std::string>())),
                 handle.at(1).get<int>(), handle.at(2).get<int>()};
  if (text.contains("falloff")) edit.falloff = Falloff::linear;
  if (text.contains("move")) {
    edit.operation = Move{vector_of(text.at("move"))};
  } else if (text.contains("axis")) {
    edit.operation = Rotate{vector_of(text.at("axis")), finite(text.at("radians"))};
  } else {
    Scale scale{finite(text.at("factor")), std::nullopt};
    if (text.contains("along")) scale.along = vector_of(text.at("along"));
    edit.operation = scale;
  }
  validate(edit);
  return edit;
}

json json_of(const SearchNode& node) {
  const Stackability& at = node.measured;
  const Distortion& change = node.energy.distortion;
  json text = {{"parent", node.parent},
               {"queue", node.queue},
               {"state", state_names[static_cast<std::size_t>(node.state)]},
               {"direction", json_of(node.direction)},
               {"measured", {at.f_max, at.extent, at.box_volume, at.stack_box_volume, at.value}},
               {"distortion", {change.volume, change.proximity, change.box, change.symmetry}},
               {"energy", {node.energy.gain, node.energy.value}},
               {"key", node.key}};
  if (node.parent < 0) return text;
  text["edit"] = json_of(node.edit);
  text["why"] = node.why;
  return text;
}

SearchNode node_of(const json& text, int id, int queues) {
  SearchNode node;
  node.parent = text.at("parent").get<int>();
  node.queue = text.at("queue").get<int>();
  const bool is_root = id < queues;
  if (node.parent < -1 || node.parent >= id || node.queue < 0 || node.queue >= queues ||
      is_root != (node.parent < 0) || (is_root && node.queue != id))
    throw InputError("candidate " + std::to_string(id) + " of a saved search has no such parent or queue");
  node.state = static_cast<NodeState>(index_in(state_names, text.at("state").get<std::string>()));
  node.direction = Direction(vector_of(text.at("direction"))).vector();
  const json& at = text.at("measured");
  node.measured = {node.direction,   finite(at.at(0)), finite(at.at(1)),
                   finite(at.at(2)), finite(at.at(3)), finite(at.at(4))};
  const json& change = text.at("distortion");
  node.energy.distortion = {finite(change.at(0)), finite(change.at(1)), finite(change.at(2)),
                            finite(change.at(3))};
  node.energy.gain = finite(text.at("energy").at(0));
  node.energy.value = finite(text.at("energy").at(1));
  node.key = text.at("key").get<std::uint64_t>();
  if (node.parent < 0) return node;
  node.edit = edit_of(text.at("edit"));
  node.why = text.at("why").get<std::string>();
  return node;
}

SearchState state_of(const json& text, std::uint64_t task, int queues) {
  if (text.at("format").get<std::string>() != format_name || text.at("version").get<int>() != format_version)
    throw InputError("this is no saved search of this version of the program");
  if (text.at("task").get<std::uint64_t>() != task)
    throw InputError("the saved search belongs to another shape, other requirements or other options");
  SearchState state(task, queues);
  int id = 0;
  for (const json& node : text.at("candidates")) state.tree.add(node_of(node, id++, queues));
  const int turn = text.at("turn").get<int>();
  if (turn < 0 || turn >= queues) throw InputError("a saved search names a queue that does not exist");
  state.tree.set_turn(turn);
  state.refusals = text.at("refusals").get<std::map<std::string, std::int64_t>>();
  state.expanded = text.at("expanded").get<std::int64_t>();
  state.evaluated = text.at("evaluated").get<std::int64_t>();
  return state;
}

}  // namespace

std::string text_of(const SearchState& state) {
  json candidates = json::array();
  for (const SearchNode& node : state.tree.nodes()) candidates.push_back(json_of(node));
  const json text = {{"format", format_name},      {"version", format_version},
                     {"task", state.task},         {"turn", state.tree.turn()},
                     {"expanded", state.expanded}, {"evaluated", state.evaluated},
                     {"refusals", state.refusals}, {"candidates", std::move(candidates)}};
  return text.dump(-1, ' ', false, json::error_handler_t::replace);
}

SearchState read_state(const std::string& text, std::uint64_t task, int queues) {
  try {
    return state_of(json::parse(text), task, queues);
  } catch (const json::exception& error) {
    throw InputError(std::string("a saved search cannot be read: ") + error.what());
  } catch (const UsageError& error) {
    throw InputError(std::string("a saved search cannot be read: ") + error.what());
  }
}

}  // namespace stackabilization::detail

bool stackabilization::is_search_state(const std::string& text) {
  using nlohmann::json;
  const json state = json::parse(text, nullptr, false);
  return state.is_object() && state.value("format", json()) == detail::format_name;
}
