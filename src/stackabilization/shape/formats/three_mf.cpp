#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <utility>
#include <vector>

#include "stackabilization/shape/errors.h"
#include "stackabilization/shape/formats/formats.h"
#include "stackabilization/shape/formats/shape_builder.h"
#include "stackabilization/shape/formats/zip.h"

namespace stackabilization {

namespace {

/// A few nested components can multiply without bounds; no real assembly comes near this.
constexpr std::int64_t most_placed_objects = 100000;

constexpr const char* default_model = "3D/3dmodel.model";
constexpr const char* core_namespace = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
constexpr const char* relationships_namespace =
    "http://schemas.openxmlformats.org/package/2006/relationships";
constexpr const char* model_relationship = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";

struct UnitName {
  const char* name;
  Unit unit;
};
constexpr std::array<UnitName, 6> unit_names = {{{"micron", Unit::micrometre},
                                                 {"millimeter", Unit::millimetre},
                                                 {"centimeter", Unit::centimetre},
                                                 {"meter", Unit::metre},
                                                 {"inch", Unit::inch},
                                                 {"foot", Unit::foot}}};

/// Empty is the identity, so that untransformed coordinates stay as they are to the bit.
using Transform = std::optional<Eigen::Affine3d>;

Transform operator*(const Transform& outer, const Transform& inner) {
  if (!outer) return inner;
  if (!inner) return outer;
  return *outer * *inner;
}

/// A build item or a component: an object placed somewhere.
struct Placement {
  std::string model;  ///< Entry of the archive that holds the object.
  std::int64_t object = 0;
  Transform transform;
};

struct Object {
  std::string name;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<Placement> components;
};

struct Model {
  Unit unit = Unit::millimetre;
  std::map<std::int64_t, Object> objects;
  std::vector<Placement> items;
};

/// Name without a namespace prefix.
const char* local_name(const char* name) {
  const char* const colon = std::strchr(name, ':');
  return colon ? colon + 1 : name;
}

bool is_named(pugi::xml_node node, const char* name) {
  return std::strcmp(local_name(node.name()), name) == 0;
}

pugi::xml_node child(pugi::xml_node node, const char* name) {
  for (const pugi::xml_node candidate : node.children())
    if (is_named(candidate, name)) return candidate;
  return {};
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

  void parse_object(pugi::xml_node node, Model& model) const {
    const std::int64_t id = integer(node, "id");
    Object object;
    object.name = node.attribute("name").value();
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

/// Expands the build items of a model into a Shape. Models of other entries (production extension) are read
/// on demand.
class Assembler {
 public:
  Assembler(const Source& source, const ZipReader* archive, std::string entry, Model root)
      : name_(source.name), archive_(archive), root_(entry), builder_(source.name) {
    add_model(std::move(entry), std::move(root));
  }

  Shape assemble() {
    const Model& root = models_.at(root_);
    if (root.items.empty())
      for (const auto& [id, object] : root.objects) place({root_, id, std::nullopt}, std::nullopt, 0);
    for (const Placement& item : root.items) place(item, std::nullopt, 0);
    Shape shape = builder_.finish();
    shape.unit = root.unit;
    return shape;
  }

 private:
  const Model& add_model(std::string entry, Model model) {
    for (const auto& [id, object] : model.objects)
      stored_triangles_ += static_cast<std::int64_t>(object.triangles.size());
    return models_.emplace(std::move(entry), std::move(model)).first->second;
  }

  const Object& find(const Placement& placement) {
    auto model = models_.find(placement.model);
    if (model == models_.end()) {
      const std::optional<std::string> text = archive_ ? archive_->entry(placement.model) : std::nullopt;
      if (!text)
        throw InputError(name_ + ": expected the entry " + in_quotes(placement.model) + " in the archive");
      add_model(placement.model, ModelParser({*text, name_}, placement.model).parse());
      model = models_.find(placement.model);
    }
    const auto object = model->second.objects.find(placement.object);
    if (object == model->second.objects.end())
      throw InputError(name_ + ": expected an object " + std::to_string(placement.object) + " in " +
                       in_quotes(placement.model));
    return object->second;
  }

  void place(const Placement& placement, const Transform& outer, int depth) {
    constexpr int deepest = 64;
    if (depth > deepest)
      throw InputError(name_ + ": the components of object " + std::to_string(placement.object) +
                       " are nested without end");
    const Object& object = find(placement);
    const Transform transform = outer * placement.transform;
    if (++placed_objects_ > most_placed_objects)
      throw InputError(name_ + ": the components make more than " + std::to_string(most_placed_objects) +
                       " objects");
    placed_triangles_ += static_cast<std::int64_t>(object.triangles.size());
    if (placed_triangles_ > std::max(2 * stored_triangles_, most_instanced_triangles))
      throw InputError(name_ + ": the components make more than " + std::to_string(most_instanced_triangles) +
                       " triangles");
    if (!object.triangles.empty()) add_mesh(object, transform);
    for (const Placement& component : object.components) place(component, transform, depth + 1);
  }

  void add_mesh(const Object& object, const Transform& transform) {
    builder_.begin_part(object.name);
    const std::int64_t first = builder_.vertex_count();
    for (const Eigen::Vector3d& vertex : object.vertices) {
      const Eigen::Vector3d point = transform ? *transform * vertex : vertex;
      if (!point.allFinite())
        throw InputError(name_ + ": a transform takes vertices of " + in_quotes(object.name) +
                         " out of range");
      builder_.add_vertex(point.x(), point.y(), point.z());
    }
    const bool mirrored = transform && transform->linear().determinant() < 0;
    for (std::array<std::int32_t, 3> corners : object.triangles) {
      for (std::int32_t& corner : corners) corner += static_cast<std::int32_t>(first);
      if (mirrored) std::swap(corners[1], corners[2]);
      builder_.add_face(corners);
    }
  }

  const std::string& name_;
  const ZipReader* archive_;
  std::string root_;
  std::map<std::string, Model> models_;
  ShapeBuilder builder_;
  std::int64_t stored_triangles_ = 0;
  std::int64_t placed_triangles_ = 0;
  std::int64_t placed_objects_ = 0;
};

/// Entry of the archive that its relationships call the model.
std::string model_entry(const ZipReader& archive) {
  const std::optional<std::string> relationships = archive.entry("_rels/.rels");
  pugi::xml_document document;
  if (!relationships || !document.load_buffer(relationships->data(), relationships->size()))
    return default_model;
  for (const pugi::xml_node node : child(document, "Relationships").children())
    if (std::string_view(node.attribute("Type").value()) == model_relationship) {
      const std::string target = node.attribute("Target").value();
      return target.starts_with('/') ? target.substr(1) : target;
    }
  return default_model;
}

void append_attribute(std::string& text, const char* name, double value) {
  text += std::string(" ") + name + "=\"";
  append_number(text, value);
  text += '"';
}

void append_attribute(std::string& text, const char* name, std::int32_t value) {
  text += std::string(" ") + name + "=\"" + std::to_string(value) + "\"";
}

std::string model_xml(const Shape& shape) {
  const char* unit = "millimeter";
  for (const UnitName& candidate : unit_names)
    if (candidate.unit == shape.unit) unit = candidate.name;
  std::string text = std::string("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"") + unit +
                     "\" xml:lang=\"en-US\" xmlns=\"" + core_namespace + "\">\n<resources>\n";
  std::string items;
  const std::vector<PartMesh> meshes = split_by_part(shape);
  for (std::size_t part = 0; part < meshes.size(); ++part) {
    if (meshes[part].triangles.empty()) continue;
    const std::string id = std::to_string(part + 1);
    text += "<object id=\"" + id + "\" type=\"model\" name=\"" + escaped_xml(shape.part_names[part]) +
            "\">\n<mesh>\n<vertices>\n";
    for (const std::int32_t v : meshes[part].vertices) {
      text += "<vertex";
      append_attribute(text, "x", shape.vertices(v, 0));
      append_attribute(text, "y", shape.vertices(v, 1));
      append_attribute(text, "z", shape.vertices(v, 2));
      text += "/>\n";
    }
    text += "</vertices>\n<triangles>\n";
    for (const std::array<std::int32_t, 3>& triangle : meshes[part].triangles) {
      text += "<triangle";
      append_attribute(text, "v1", triangle[0]);
      append_attribute(text, "v2", triangle[1]);
      append_attribute(text, "v3", triangle[2]);
      text += "/>\n";
    }
    text += "</triangles>\n</mesh>\n</object>\n";
    items += "<item objectid=\"" + id + "\"/>\n";
  }
  return text + "</resources>\n<build>\n" + items + "</build>\n</model>\n";
}

}  // namespace

Shape read_three_mf_model(const Source& source) {
  return Assembler(source, nullptr, "", ModelParser(source, "").parse()).assemble();
}

Shape read_three_mf(const Source& source) {
  const ZipReader archive(source);
  const std::string entry = model_entry(archive);
  const std::optional<std::string> text = archive.entry(entry);
  if (!text) throw InputError(source.name + ": expected the entry " + in_quotes(entry) + " in the archive");
  return Assembler(source, &archive, entry, ModelParser({*text, source.name}, entry).parse()).assemble();
}

std::string write_three_mf(const Shape& shape) {
  const std::string types =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\n"
      "<Default Extension=\"rels\" "
      "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\n"
      "<Default Extension=\"model\" "
      "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>\n"
      "</Types>\n";
  const std::string relationships =
      std::string("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Relationships xmlns=\"") +
      relationships_namespace + "\">\n<Relationship Target=\"/" + default_model + "\" Id=\"rel0\" Type=\"" +
      model_relationship + "\"/>\n</Relationships>\n";
  return zip(
      {{"[Content_Types].xml", types}, {"_rels/.rels", relationships}, {default_model, model_xml(shape)}});
}

}  // namespace stackabilization
