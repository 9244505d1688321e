#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "io/formats/json_node.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/improvement/history.h"
#include "stackabilization/io/read_file.h"
#include "stackabilization/structure/project_file.h"

namespace stackabilization {

namespace {

using detail::JsonNode;
using Json = nlohmann::ordered_json;

const std::vector<std::string> handle_kinds = {"part", "face", "corner", "section", "point", "wire", "shape"};
const std::vector<std::string> falloffs = {"gaussian", "linear"};
const std::vector<std::string> extent_ends = {"free", "fixed"};
constexpr std::array model_kinds = {DeformationKind::controllers, DeformationKind::surface,
                                    DeformationKind::iwires, DeformationKind::gap_scaling};

bool has_part(HandleKind kind) {
  return kind == HandleKind::part || kind == HandleKind::face || kind == HandleKind::corner ||
         kind == HandleKind::section;
}

bool has_index(HandleKind kind) {
  return kind != HandleKind::part && kind != HandleKind::shape;
}

/// Writes a history as JSON. Reading the text back, before it is used, checks the input.
class HistoryWriter {
 public:
  explicit HistoryWriter(const Project& project) : project_(project) {}

  /// Returns the JSON text, one node per line.
  std::string text() const {
    std::string text = "{\"model\": \"" + name_of(project_.space.kind) +
                       "\", \"model_direction\": " + list(project_.space.direction.vector()).dump() +
                       ", \"current\": " + std::to_string(project_.history.current) + ", \"nodes\": [";
    for (const HistoryNode& node : project_.history.nodes) {
      text += (&node == &project_.history.nodes.front() ? "\n    " : ",\n    ");
      text += json(node).dump();
    }
    return text + "]}";
  }

 private:
  static Json list(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

  const std::string& part_name(int part) const {
    const std::vector<std::string>& names = project_.rest.shape.part_names;
    if (part < 0 || static_cast<std::size_t>(part) >= names.size())
      throw InputError("the history names part " + std::to_string(part) + ", and the shape has " +
                       std::to_string(names.size()));
    return names[static_cast<std::size_t>(part)];
  }

  Json json(const HistoryNode& node) const {
    Json json = {{"parent", node.parent},
                 {"name", node.name},
                 {"direction", list(node.direction)},
                 {"stackability", node.stackability},
                 {"energy", node.energy}};
    for (const Edit& edit : node.edits) json["edits"].push_back(this->json(edit));
    const Json constraints = this->json(node.constraints);
    if (!constraints.empty()) json["constraints"] = constraints;
    return json;
  }

  Json json(const Edit& edit) const {
    Json handle = {{"kind", handle_kinds.at(static_cast<std::size_t>(edit.handle.kind))}};
    if (has_part(edit.handle.kind)) handle["part"] = part_name(edit.handle.part);
    if (has_index(edit.handle.kind)) handle["index"] = edit.handle.index;
    Json json = {{"handle", handle}};
    if (const auto* move = std::get_if<Move>(&edit.operation)) {
      json["move"] = list(move->by);
    } else if (const auto* rotate = std::get_if<Rotate>(&edit.operation)) {
      json["rotate"] = {{"axis", list(rotate->axis)}, {"radians", rotate->radians}};
    } else {
      const Scale& scale = std::get<Scale>(edit.operation);
      json["scale"] = {{"factor", scale.factor}};
      if (scale.along) json["scale"]["along"] = list(*scale.along);
    }
    if (edit.falloff != Falloff::gaussian)
      json["falloff"] = falloffs.at(static_cast<std::size_t>(edit.falloff));
    return json;
  }

  Json json(const DeformationConstraints& constraints) const {
    Json json = Json::object();
    if (constraints.keep_extent) json["keep_extent"] = list(constraints.keep_extent->vector());
    if (constraints.extent_ends != ExtentEnds::free)
      json["extent_ends"] = extent_ends.at(static_cast<std::size_t>(constraints.extent_ends));
    if (constraints.box_tolerance) json["box_tolerance"] = *constraints.box_tolerance;
    for (const int part : constraints.fixed_parts) json["fixed_parts"].push_back(part_name(part));
    for (const Eigen::Vector3d& point : constraints.fixed_points) json["fixed_points"].push_back(list(point));
    return json;
  }

  const Project& project_;
};

class HistoryReader {
 public:
  HistoryReader(const JsonNode& root, const StructuredShape& rest) : root_(root), rest_(rest) {}

  /// Reads the project except for the shape at rest.
  Project read() {
    root_.expect_keys({"model", "model_direction", "current", "nodes"});
    std::vector<std::string> names;
    for (const DeformationKind kind : model_kinds) names.push_back(name_of(kind));
    project_.space.kind = model_kinds[root_["model"].one_of(names)];
    project_.space.direction = Direction(direction(root_["model_direction"]));
    const JsonNode nodes = root_["nodes"];
    if (nodes.list_size() == 0) nodes.fail_expected("at least one node");
    for (std::size_t k = 0; k < nodes.list_size(); ++k)
      project_.history.nodes.push_back(node(nodes[k], static_cast<int>(k)));
    project_.history.current =
        static_cast<int>(root_["current"].integer(0, static_cast<std::int64_t>(nodes.list_size()) - 1));
    return std::move(project_);
  }

 private:
  static Eigen::Vector3d vector(const JsonNode& node) { return node.numbers(3); }

  static Eigen::Vector3d direction(const JsonNode& node) {
    const Eigen::Vector3d result = vector(node);
    try {
      return Direction(result).vector();
    } catch (const UsageError& error) {
      node.fail(error.what());
    }
  }

  HistoryNode node(const JsonNode& node, int row) const {
    node.expect_keys({"parent", "name", "direction", "stackability", "energy", "edits", "constraints"}, 2);
    HistoryNode result;
    if (row == 0)
      result.parent = static_cast<int>(node["parent"].integer(-1, -1));
    else
      result.parent = static_cast<int>(node["parent"].integer(0, row - 1));
    result.name = node["name"].text();
    result.direction = direction(node["direction"]);
    result.stackability = node["stackability"].number();
    result.energy = node["energy"].number();
    if (row == 0 && node.has("edits")) node["edits"].fail("expected no edits in the shape at rest");
    if (node.has("edits"))
      for (std::size_t k = 0; k < node["edits"].list_size(); ++k)
        result.edits.push_back(edit(node["edits"][k]));
    if (node.has("constraints")) result.constraints = constraints(node["constraints"]);
    return result;
  }

  Edit edit(const JsonNode& node) const {
    node.expect_keys({"handle", "move", "rotate", "scale", "falloff"}, 4);
    if (int{node.has("move")} + int{node.has("rotate")} + int{node.has("scale")} != 1)
      node.fail("expected one of the keys 'move', 'rotate' and 'scale'");
    Edit result;
    result.handle = handle(node["handle"]);
    if (node.has("move")) {
      result.operation = Move{vector(node["move"])};
    } else if (node.has("rotate")) {
      const JsonNode rotate = node["rotate"];
      rotate.expect_keys({"axis", "radians"});
      result.operation = Rotate{vector(rotate["axis"]), rotate["radians"].number()};
    } else {
      const JsonNode scale = node["scale"];
      scale.expect_keys({"factor", "along"}, 1);
      Scale operation{scale["factor"].number(), {}};
      if (scale.has("along")) operation.along = vector(scale["along"]);
      result.operation = operation;
    }
    if (node.has("falloff"))
      result.falloff = std::array{Falloff::gaussian, Falloff::linear}[node["falloff"].one_of(falloffs)];
    try {
      validate(result, rest_.structure.diagonal);
    } catch (const UsageError& error) {
      node.fail(error.what());
    }
    return result;
  }

  Handle handle(const JsonNode& node) const {
    node.expect_keys({"kind", "part", "index"}, 2);
    Handle result;
    result.kind = static_cast<HandleKind>(node["kind"].one_of(handle_kinds));
    if (has_part(result.kind) && has_index(result.kind))
      node.expect_keys({"kind", "part", "index"});
    else if (has_part(result.kind))
      node.expect_keys({"kind", "part"});
    else if (has_index(result.kind))
      node.expect_keys({"kind", "index"});
    else
      node.expect_keys({"kind"});
    if (has_part(result.kind)) result.part = static_cast<int>(node["part"].one_of(rest_.shape.part_names));
    if (has_index(result.kind))
      result.index = static_cast<int>(node["index"].integer(0, max_index(node, result)));
    return result;
  }

  /// Returns the largest index of a handle of this kind. Without a bound for wires: only their model knows
  /// how many there are.
  std::int64_t max_index(const JsonNode& node, const Handle& handle) const {
    if (handle.kind == HandleKind::point) return rest_.shape.vertex_count() - 1;
    if (handle.kind == HandleKind::wire || project_.space.kind != DeformationKind::controllers)
      return std::numeric_limits<int>::max();
    const Part& part = rest_.structure.parts[static_cast<std::size_t>(handle.part)];
    if (const auto* cylinder = std::get_if<GeneralizedCylinder>(&part.primitive)) {
      if (handle.kind != HandleKind::section)
        node.fail("expected a cross-section: part '" + part.name + "' is a generalized cylinder");
      return cylinder->centres.rows() - 1;
    }
    if (handle.kind == HandleKind::section)
      node.fail("expected a face or a corner: part '" + part.name + "' is a cuboid");
    return handle.kind == HandleKind::face ? 5 : 7;
  }

  DeformationConstraints constraints(const JsonNode& node) const {
    node.expect_keys({"keep_extent", "extent_ends", "box_tolerance", "fixed_parts", "fixed_points"}, 5);
    DeformationConstraints result;
    if (node.has("keep_extent")) result.keep_extent = Direction(direction(node["keep_extent"]));
    if (node.has("extent_ends"))
      result.extent_ends =
          std::array{ExtentEnds::free, ExtentEnds::fixed}[node["extent_ends"].one_of(extent_ends)];
    if (node.has("box_tolerance")) {
      result.box_tolerance = node["box_tolerance"].number();
      if (*result.box_tolerance < 0) node["box_tolerance"].fail_expected("a number that is not negative");
    }
    if (node.has("fixed_parts"))
      for (std::size_t k = 0; k < node["fixed_parts"].list_size(); ++k)
        result.fixed_parts.push_back(static_cast<int>(node["fixed_parts"][k].one_of(rest_.shape.part_names)));
    if (node.has("fixed_points"))
      for (std::size_t k = 0; k < node["fixed_points"].list_size(); ++k)
        result.fixed_points.push_back(vector(node["fixed_points"][k]));
    try {
      validate(result, rest_.shape);
    } catch (const UsageError& error) {
      node.fail(error.what());
    }
    return result;
  }

  JsonNode root_;
  const StructuredShape& rest_;
  Project project_;
};

/// Reads a project without its shape from the value of the entry "history".
Project project_of_history(const std::string& text, const std::string& name, const StructuredShape& rest) {
  const Json value = detail::parse_json(text, name);
  return HistoryReader(JsonNode(value, name, "/history"), rest).read();
}

std::string history_text(const Project& project) {
  try {
    std::string text = HistoryWriter(project).text();
    project_of_history(text, "the history to be written", project.rest);
    return text;
  } catch (const Json::exception&) {
    throw InputError("a project file holds UTF-8 text, and a name in the history is none");
  }
}

}  // namespace

std::string project_text(const Project& project) {
  ProjectSections sections;
  if (!project.history.nodes.empty()) sections.history = history_text(project);
  return project_text(project.rest, sections);
}

Project project_with_history(std::string_view text, const std::string& name) {
  ProjectContents contents = project_contents(text, name);
  Project project;
  if (contents.sections.history)
    project = project_of_history(*contents.sections.history, name, contents.structured);
  project.rest = std::move(contents.structured);
  return project;
}

Project read_project_with_history(const std::filesystem::path& path) {
  return project_with_history(read_file(path), path == "-" ? "standard input" : path.string());
}

}  // namespace stackabilization
