#include "io/formats/three_mf_model.h"

#include <cstring>
#include <utility>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/utf8.h"

namespace stackabilization::three_mf {

namespace {

/// Name without a namespace prefix.
const char* local_name(const char* name) {
  const char* const colon = std::strchr(name, ':');
  return colon ? colon + 1 : name;
}

bool is_named(pugi::xml_node node, const char* name) {
  return std::strcmp(local_name(node.name()), name) == 0;
}

/// The XML of one model into a Model.
class ModelParser {
 public:
  ModelParser(const Source& source, std::string entry) : name_(source.name), entry_(std::move(entry)) {
    const pugi::xml_parse_result result = document_.load_buffer(source.bytes.data(), source.bytes.size());
    if (!result)
      fail("byte " + std::to_string(result.offset) + ": expected XML, found: " + result.description());
  }

  Model parse() {
    const pugi::xml_node root = child(document_, "model");
    if (!root) fail("expected the element <model>");
    check_extensions(root);
    Model model;
    model.unit = parse_unit(root);
    for (const pugi::xml_node node : child(root, "resources").children())
      if (is_named(node, "object")) parse_object(node, model);
    for (const pugi::xml_node node : child(root, "build").children())
      if (is_named(node, "item")) model.items.push_back(parse_placement(node));
    return model;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(name_ + ": " + (entry_.empty() ? "" : entry_ + ": ") + message);
  }

  /// An extension that a file requires must be understood; these leave the geometry as it is.
  void check_extensions(pugi::xml_node root) const {
    const std::string name;
    TextCursor required({root.attribute("requiredextensions").value(), name});
    for (std::string_view prefix = required.token_of_any_line(); !prefix.empty();
         prefix = required.token_of_any_line()) {
      const std::string_view space = root.attribute(("xmlns:" + std::string(prefix)).c_str()).value();
      const bool is_harmless = space.find("/production/") != std::string_view::npos ||
                               space.find("/material/") != std::string_view::npos ||
                               space.find("/trianglesets/") != std::string_view::npos;
      if (!is_harmless)
        fail("the file requires the extension " + in_quotes(prefix) + ", which is not supported");
    }
  }

  Unit parse_unit(pugi::xml_node root) const {
    const std::string_view unit = root.attribute("unit").as_string("millimeter");
    for (const UnitName& candidate : unit_names)
      if (candidate.name == unit) return candidate.unit;
    fail("expected a unit such as millimeter, found " + in_quotes(unit));
  }

  std::int64_t integer(pugi::xml_node node, const char* attribute) const {
    const std::string_view text = node.attribute(attribute).value();
    const std::optional<std::int64_t> value = parse_integer(text);
    if (!value) fail(place(node) + ": expected an integer as " + attribute + ", found " + in_quotes(text));
    return *value;
  }

  double number(pugi::xml_node node, const char* attribute) const {
    const std::string_view text = node.attribute(attribute).value();
    const std::optional<double> value = parse_number(text);
    if (!value)
      fail(place(node) + ": expected a finite number as " + attribute + ", found " + in_quotes(text));
    return *value;
  }

  static std::string place(pugi::xml_node node) {
    return std::string(local_name(node.name())) + " at byte " + std::to_string(node.offset_debug());
  }

  /// Empty where there is none.
  std::string name_in(pugi::xml_node node, const char* attribute) const {
    const std::string name = node.attribute(attribute).value();
    if (!is_utf8(name)) fail(place(node) + ": expected a name in UTF-8, found " + in_quotes(name));
    return name;
  }

  void parse_object(pugi::xml_node node, Model& model) const {
    const std::int64_t id = integer(node, "id");
    Object object;
    object.name = name_in(node, "name");
    if (object.name.empty()) object.name = "object_" + std::to_string(id);
    if (const pugi::xml_node mesh = child(node, "mesh")) parse_mesh(mesh, object);
    for (const pugi::xml_node component : child(node, "components").children())
      if (is_named(component, "component")) object.components.push_back(parse_placement(component));
    if (!model.objects.emplace(id, std::move(object)).second)
      fail("object " + std::to_string(id) + " is defined twice");
  }

  void parse_mesh(pugi::xml_node mesh, Object& object) const {
    for (const pugi::xml_node vertex : child(mesh, "vertices").children())
      if (is_named(vertex, "vertex"))
        object.vertices.emplace_back(number(vertex, "x"), number(vertex, "y"), number(vertex, "z"));
    for (const pugi::xml_node triangle : child(mesh, "triangles").children()) {
      if (!is_named(triangle, "triangle")) continue;
      std::array<std::int32_t, 3>& corners = object.triangles.emplace_back();
      const char* const names[] = {"v1", "v2", "v3"};
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::int64_t vertex = integer(triangle, names[corner]);
        if (vertex < 0 || vertex >= static_cast<std::int64_t>(object.vertices.size()))
          fail(place(triangle) + ": expected a vertex below " + std::to_string(object.vertices.size()) +
               ", found " + std::to_string(vertex));
        corners[corner] = static_cast<std::int32_t>(vertex);
      }
    }
  }

  Placement parse_placement(pugi::xml_node node) const {
    Placement placement;
    placement.object = integer(node, "objectid");
    placement.model = entry_;
    placement.name = name_in(node, "partnumber");
    for (const pugi::xml_attribute attribute : node.attributes())
      if (std::strcmp(local_name(attribute.name()), "path") == 0) placement.model = attribute.value();
    if (placement.model.starts_with('/')) placement.model.erase(0, 1);
    if (const pugi::xml_attribute text = node.attribute("transform"))
      placement.transform = parse_transform(node, text);
    return placement;
  }

  /// Twelve numbers, the rows of a 4 x 3 matrix that row vectors are multiplied by.
  Transform parse_transform(pugi::xml_node node, pugi::xml_attribute text) const {
    const std::string name;
    TextCursor cursor({text.value(), name});
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();
    for (int i = 0; i < 12; ++i) {
      const std::optional<double> value = parse_number(cursor.token_of_any_line());
      if (!value) fail(place(node) + ": expected a transform of 12 finite numbers");
      transform.matrix()(i % 3, i / 3) = *value;
    }
    if (!cursor.token_of_any_line().empty())
      fail(place(node) + ": expected a transform of 12 finite numbers");
    if (transform.matrix() == Eigen::Matrix4d::Identity()) return std::nullopt;
    return transform;
  }

  const std::string& name_;
  std::string entry_;
  pugi::xml_document document_;
};

}  // namespace

pugi::xml_node child(pugi::xml_node node, const char* name) {
  for (const pugi::xml_node candidate : node.children())
    if (is_named(candidate, name)) return candidate;
  return {};
}

Model parse_model(const Source& source, const std::string& entry) {
  return ModelParser(source, entry).parse();
}

}  // namespace stackabilization::three_mf
