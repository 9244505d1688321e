#include "improvement/design/edit_json.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/index.h"
#include "stackabilization/core/errors.h"

namespace stackabilization::detail {

namespace {

using Json = nlohmann::ordered_json;

const std::vector<std::string> falloffs = {"gaussian", "linear"};

bool has_part(HandleKind kind) {
  return kind == HandleKind::part || kind == HandleKind::face || kind == HandleKind::corner ||
         kind == HandleKind::section;
}

bool has_index(HandleKind kind) {
  return kind != HandleKind::part && kind != HandleKind::shape;
}

/// Returns the largest index of a handle of this kind and part.
std::int64_t max_index(const JsonNode& node, const Handle& handle, const StructuredShape& rest,
                       const DeformationCapabilities& capabilities) {
  if (handle.kind == HandleKind::point) return rest.shape.vertex_count() - 1;
  if (handle.kind == HandleKind::wire || !capabilities.edits_primitives)
    return std::numeric_limits<int>::max();
  const Part& part = rest.structure.parts[at(handle.part)];
  if (const auto* cylinder = std::get_if<GeneralizedCylinder>(&part.primitive)) {
    if (handle.kind != HandleKind::section)
      node.fail("expected a cross-section: part '" + part.name + "' is a generalized cylinder");
    return cylinder->centres.rows() - 1;
  }
  if (handle.kind == HandleKind::section)
    node.fail("expected a face or a corner: part '" + part.name + "' is a cuboid");
  return handle.kind == HandleKind::face ? 5 : 7;
}

Handle handle_from_json(const JsonNode& node, const StructuredShape& rest,
                        const DeformationCapabilities& capabilities) {
  node.expect_keys({"kind", "part", "index"}, 2);
  Handle handle;
  handle.kind = static_cast<HandleKind>(node["kind"].one_of(handle_kind_names()));
  std::vector<std::string_view> keys = {"kind"};
  if (has_part(handle.kind)) keys.push_back("part");
  if (has_index(handle.kind)) keys.push_back("index");
  node.expect_keys(keys);
  if (has_part(handle.kind)) handle.part = static_cast<int>(node["part"].one_of(rest.shape.part_names));
  if (has_index(handle.kind))
    handle.index = static_cast<int>(node["index"].integer(0, max_index(node, handle, rest, capabilities)));
  return handle;
}

Operation operation_from_json(const JsonNode& node) {
  if (node.has("move")) return Move{node["move"].numbers(3)};
  if (node.has("rotate")) {
    const JsonNode rotate = node["rotate"];
    rotate.expect_keys({"axis", "radians"});
    return Rotate{rotate["axis"].numbers(3), rotate["radians"].number()};
  }
  if (node.has("taper")) {
    const JsonNode taper = node["taper"];
    taper.expect_keys({"factor", "axis", "along"}, 1);
    Taper operation{taper["factor"].number(), taper["axis"].numbers(3), {}};
    if (taper.has("along")) operation.along = taper["along"].numbers(3);
    return operation;
  }
  if (node.has("lean")) {
    const JsonNode lean = node["lean"];
    lean.expect_keys({"by", "axis"});
    return Lean{lean["by"].numbers(3), lean["axis"].numbers(3)};
  }
  const JsonNode scale = node["scale"];
  scale.expect_keys({"factor", "along"}, 1);
  Scale operation{scale["factor"].number(), {}};
  if (scale.has("along")) operation.along = scale["along"].numbers(3);
  return operation;
}

}  // namespace

Json to_json(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

Json to_json(const Edit& edit, const std::vector<std::string>& part_names) {
  const HandleKind kind = edit.handle.kind;
  Json handle = {{"kind", handle_kind_names().at(static_cast<std::size_t>(kind))}};
  if (has_part(kind)) handle["part"] = name_of_part(edit.handle.part, part_names);
  if (has_index(kind)) handle["index"] = edit.handle.index;
  Json json = {{"handle", handle}};
  if (const auto* move = std::get_if<Move>(&edit.operation)) {
    json["move"] = to_json(move->by);
  } else if (const auto* rotate = std::get_if<Rotate>(&edit.operation)) {
    json["rotate"] = {{"axis", to_json(rotate->axis)}, {"radians", rotate->radians}};
  } else if (const auto* taper = std::get_if<Taper>(&edit.operation)) {
    json["taper"] = {{"factor", taper->factor}, {"axis", to_json(taper->axis)}};
    if (taper->along) json["taper"]["along"] = to_json(*taper->along);
  } else if (const auto* lean = std::get_if<Lean>(&edit.operation)) {
    json["lean"] = {{"by", to_json(lean->by)}, {"axis", to_json(lean->axis)}};
  } else {
    const Scale& scale = std::get<Scale>(edit.operation);
    json["scale"] = {{"factor", scale.factor}};
    if (scale.along) json["scale"]["along"] = to_json(*scale.along);
  }
  if (edit.falloff != Falloff::gaussian)
    json["falloff"] = falloffs.at(static_cast<std::size_t>(edit.falloff));
  return json;
}

const std::string& name_of_part(int part, const std::vector<std::string>& part_names) {
  if (part < 0 || at(part) >= part_names.size())
    throw InputError("there is no part " + std::to_string(part) + ": the shape has " +
                     std::to_string(part_names.size()));
  return part_names[at(part)];
}

Eigen::Vector3d direction_from_json(const JsonNode& node) {
  const Eigen::Vector3d vector = node.numbers(3);
  try {
    return Direction(vector).vector();
  } catch (const UsageError& error) {
    node.fail(error.what());
  }
}

Edit edit_from_json(const JsonNode& node, const StructuredShape& rest,
                    const DeformationCapabilities& capabilities) {
  node.expect_keys({"handle", "move", "rotate", "scale", "taper", "lean", "falloff"}, 6);
  const std::array operations = {"move", "rotate", "scale", "taper", "lean"};
  if (std::count_if(operations.begin(), operations.end(), [&](const char* key) { return node.has(key); }) !=
      1)
    node.fail("expected one of the keys 'move', 'rotate', 'scale', 'taper' and 'lean'");
  Edit edit;
  edit.handle = handle_from_json(node["handle"], rest, capabilities);
  edit.operation = operation_from_json(node);
  if (node.has("falloff"))
    edit.falloff = std::array{Falloff::gaussian, Falloff::linear}[node["falloff"].one_of(falloffs)];
  try {
    validate(edit, rest.structure.diagonal);
  } catch (const UsageError& error) {
    node.fail(error.what());
  }
  return edit;
}

}  // namespace stackabilization::detail
