#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "improvement/design/edit_json.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/improvement/history.h"
#include "stackabilization/io/read_file.h"
#include "stackabilization/structure/project_file.h"

namespace stackabilization {

namespace {

using detail::direction_from_json;
using detail::edit_from_json;
using detail::JsonNode;
using detail::name_of_part;
using detail::to_json;
using Json = nlohmann::ordered_json;

const std::vector<std::string> extent_ends = {"free", "fixed"};

/// Writes a history as JSON. Reading the text back, before it is used, checks the input.
class HistoryWriter {
 public:
  explicit HistoryWriter(const Project& project) : project_(project) {}

  /// Returns the JSON text, one node per line.
  std::string text() const {
    std::string text = "{\"model\": \"" + name_of(project_.space.kind) + "\", ";
    if (project_.space.direction)
      text += "\"model_direction\": " + to_json(project_.space.direction->vector()).dump() + ", ";
    if (project_.space.following == Following::smooth) text += "\"following\": \"smooth\", ";
    text += "\"current\": " + std::to_string(project_.history.current) + ", \"nodes\": [";
    for (const HistoryNode& node : project_.history.nodes) {
      text += (&node == &project_.history.nodes.front() ? "\n    " : ",\n    ");
      text += json(node).dump();
    }
    return text + "]}";
  }

 private:
  Json json(const HistoryNode& node) const {
    Json json = {{"parent", node.parent},
                 {"name", node.name},
                 {"direction", to_json(node.direction)},
                 {"stackability", node.stackability},
                 {"energy", node.energy}};
    for (const Edit& edit : node.edits) json["edits"].push_back(to_json(edit, part_names()));
    const Json constraints = this->json(node.constraints);
    if (!constraints.empty()) json["constraints"] = constraints;
    return json;
  }

  Json json(const DeformationConstraints& constraints) const {
    Json json = Json::object();
    if (constraints.keep_extent) json["keep_extent"] = to_json(constraints.keep_extent->vector());
    if (constraints.extent_ends != ExtentEnds::free)
      json["extent_ends"] = extent_ends.at(static_cast<std::size_t>(constraints.extent_ends));
    if (constraints.box_tolerance) json["box_tolerance"] = *constraints.box_tolerance;
    for (const int part : constraints.fixed_parts)
      json["fixed_parts"].push_back(name_of_part(part, part_names()));
    for (const Eigen::Vector3d& point : constraints.fixed_points)
      json["fixed_points"].push_back(to_json(point));
    return json;
  }

  const std::vector<std::string>& part_names() const { return project_.rest.shape.part_names; }

  const Project& project_;
};

class HistoryReader {
 public:
  HistoryReader(const JsonNode& root, const StructuredShape& rest) : root_(root), rest_(rest) {}

  /// Reads the project except for the shape at rest.
  Project read() {
    root_.expect_keys({"model", "current", "nodes", "model_direction", "following"}, 2);
    std::vector<std::string> names;
    for (const DeformationKind kind : deformation_kinds()) names.push_back(name_of(kind));
    project_.space.kind = deformation_kinds()[root_["model"].one_of(names)];
    if (root_.has("model_direction"))
      project_.space.direction = Direction(direction_from_json(root_["model_direction"]));
    if (root_.has("following")) {
      root_["following"].one_of({"smooth"});
      project_.space.following = Following::smooth;
    }
    const JsonNode nodes = root_["nodes"];
    if (nodes.list_size() == 0) nodes.fail_expected("at least one node");
    for (std::size_t k = 0; k < nodes.list_size(); ++k)
      project_.history.nodes.push_back(node(nodes[k], static_cast<int>(k)));
    project_.history.current =
        static_cast<int>(root_["current"].integer(0, static_cast<std::int64_t>(nodes.list_size()) - 1));
    return std::move(project_);
  }

 private:
  HistoryNode node(const JsonNode& node, int row) const {
    node.expect_keys({"parent", "name", "direction", "stackability", "energy", "edits", "constraints"}, 2);
    HistoryNode result;
    if (row == 0)
      result.parent = static_cast<int>(node["parent"].integer(-1, -1));
    else
      result.parent = static_cast<int>(node["parent"].integer(0, row - 1));
    result.name = node["name"].text();
    result.direction = direction_from_json(node["direction"]);
    result.stackability = node["stackability"].number();
    result.energy = node["energy"].number();
    if (row == 0 && node.has("edits")) node["edits"].fail("expected no edits in the shape at rest");
    if (node.has("edits"))
      for (std::size_t k = 0; k < node["edits"].list_size(); ++k)
        result.edits.push_back(edit_from_json(node["edits"][k], rest_, capabilities_of(project_.space.kind)));
    if (node.has("constraints")) result.constraints = constraints(node["constraints"]);
    return result;
  }

  DeformationConstraints constraints(const JsonNode& node) const {
    node.expect_keys({"keep_extent", "extent_ends", "box_tolerance", "fixed_parts", "fixed_points"}, 5);
    DeformationConstraints result;
    if (node.has("keep_extent")) result.keep_extent = Direction(direction_from_json(node["keep_extent"]));
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
        result.fixed_points.push_back(node["fixed_points"][k].numbers(3));
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

std::string edit_json(const Edit& edit, const std::vector<std::string>& part_names) {
  return to_json(edit, part_names).dump();
}

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
