#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "io/formats/formats.h"
#include "io/formats/shape_builder.h"
#include "io/formats/three_mf_model.h"
#include "io/formats/zip.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

using namespace three_mf;

constexpr const char* default_model = "3D/3dmodel.model";
constexpr const char* core_namespace = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
constexpr const char* relationships_namespace =
    "http://schemas.openxmlformats.org/package/2006/relationships";
constexpr const char* model_relationship = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
Transform compose(const Transform& outer, const Transform& inner) {
  if (!outer) return inner;
  if (!inner) return outer;
  return *outer * *inner;
}

/// Rounded as `transformed` does it, so that a file of placements has the vertices that were meant.
Points placed_vertices(const Object& object, const Transform& transform) {
  Shape shape;
  shape.vertices.resize(static_cast<Eigen::Index>(object.vertices.size()), 3);
  for (std::size_t v = 0; v < object.vertices.size(); ++v)
    shape.vertices.row(static_cast<Eigen::Index>(v)) = object.vertices[v].transpose();
  if (!transform) return shape.vertices;
  if (!transform->matrix().allFinite())
    return Points::Constant(shape.vertices.rows(), 3, std::numeric_limits<double>::infinity());
  return transformed(shape, transform->linear(), transform->translation()).vertices;
}

/// Expands the build items of a model into a Shape. Models of other entries (production extension) are read
/// on demand.
class ThreeMfAssembler {
 public:
  ThreeMfAssembler(const Source& source, const ZipReader* archive, std::string entry, Model root)
      : name_(source.name), archive_(archive), root_(entry), builder_(source.name) {
    add_model(std::move(entry), std::move(root));
  }

  Shape assemble() {
    const Model& root = models_.at(root_);
    if (root.items.empty())
      for (const auto& [id, object] : root.objects) place({root_, id, std::nullopt, ""}, std::nullopt, "", 0);
    for (const Placement& item : root.items) place(item, std::nullopt, item.name, 0);
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
      add_model(placement.model, parse_model({*text, name_}, placement.model));
      model = models_.find(placement.model);
    }
    const auto object = model->second.objects.find(placement.object);
    if (object == model->second.objects.end())
      throw InputError(name_ + ": expected an object " + std::to_string(placement.object) + " in " +
                       in_quotes(placement.model));
    return object->second;
  }

  /// `item` is the name of the build item that it belongs to.
  void place(const Placement& placement, const Transform& outer, const std::string& item, int depth) {
    constexpr int deepest = 64;
    if (depth > deepest)
      throw InputError(name_ + ": the components of object " + std::to_string(placement.object) +
                       " are nested without end");
    const Object& object = find(placement);
    const Transform transform = compose(outer, placement.transform);
    if (++placed_objects_ > max_placed_objects)
      throw InputError(name_ + ": the components make more than " + std::to_string(max_placed_objects) +
                       " objects");
    placed_triangles_ += static_cast<std::int64_t>(object.triangles.size());
    if (placed_triangles_ > std::max(2 * stored_triangles_, max_instanced_triangles))
      throw InputError(name_ + ": the components make more than " + std::to_string(max_instanced_triangles) +
                       " triangles");
    if (!object.triangles.empty()) add_mesh(object, transform, item);
    for (const Placement& component : object.components) place(component, transform, item, depth + 1);
  }

  void add_mesh(const Object& object, const Transform& transform, const std::string& item) {
    builder_.begin_part(item.empty() ? object.name : item + "/" + object.name);
    const std::int64_t first = builder_.vertex_count();
    const Points vertices = placed_vertices(object, transform);
    for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
      const Eigen::Vector3d point = vertices.row(v).transpose();
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

void append_attribute(std::string& text, const char* name, std::int64_t value) {
  text += std::string(" ") + name + "=\"" + std::to_string(value) + "\"";
}

/// Composes the XML of a model: an object per part, one of them all per shape of several parts, and an item
/// per copy; without copies, an item per part.
class ModelWriter {
 public:
  std::string write(const Copies& copies) {
    const char* unit = "millimeter";
    for (const UnitName& candidate : unit_names)
      if (candidate.unit == copies.shapes.front().unit) unit = candidate.name;
    text_ = std::string("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"") + unit +
            "\" xml:lang=\"en-US\" xmlns=\"" + core_namespace + "\">\n<resources>\n";
    std::vector<std::vector<std::int64_t>> objects;
    for (const Shape& shape : copies.shapes) objects.push_back(add_shape(shape, !copies.placed.empty()));
    text_ += "</resources>\n<build>\n";
    if (copies.placed.empty())
      for (const std::int64_t id : objects.front()) add_item(id, nullptr);
    for (const PlacedCopy& copy : copies.placed)
      for (const std::int64_t id : objects[copy.shape]) add_item(id, &copy);
    return text_ + "</build>\n</model>\n";
  }

 private:
  /// Returns the objects of a shape, `as_one` at most one.
  std::vector<std::int64_t> add_shape(const Shape& shape, bool as_one) {
    const std::vector<PartMesh> meshes = split_by_part(shape);
    std::vector<std::int64_t> objects;
    for (std::size_t part = 0; part < meshes.size(); ++part) {
      ++last_id_;
      if (meshes[part].triangles.empty()) continue;
      add_object(shape, meshes[part], last_id_, shape.part_names[part]);
      objects.push_back(last_id_);
    }
    if (!as_one || objects.size() < 2) return objects;
    add_assembly(++last_id_, objects);
    return {last_id_};
  }

  void add_object(const Shape& shape, const PartMesh& mesh, std::int64_t id, const std::string& name) {
    text_ += "<object";
    append_attribute(text_, "id", id);
    text_ += " type=\"model\" name=\"" + escaped_xml(name) + "\">\n<mesh>\n<vertices>\n";
    for (const std::int32_t v : mesh.vertices) {
      text_ += "<vertex";
      append_attribute(text_, "x", shape.vertices(v, 0));
      append_attribute(text_, "y", shape.vertices(v, 1));
      append_attribute(text_, "z", shape.vertices(v, 2));
      text_ += "/>\n";
    }
    text_ += "</vertices>\n<triangles>\n";
    for (const std::array<std::int32_t, 3>& triangle : mesh.triangles) {
      text_ += "<triangle";
      append_attribute(text_, "v1", std::int64_t{triangle[0]});
      append_attribute(text_, "v2", std::int64_t{triangle[1]});
      append_attribute(text_, "v3", std::int64_t{triangle[2]});
      text_ += "/>\n";
    }
    text_ += "</triangles>\n</mesh>\n</object>\n";
  }

  void add_assembly(std::int64_t id, const std::vector<std::int64_t>& components) {
    text_ += "<object";
    append_attribute(text_, "id", id);
    text_ += " type=\"model\">\n<components>\n";
    for (const std::int64_t object : components) {
      text_ += "<component";
      append_attribute(text_, "objectid", object);
      text_ += "/>\n";
    }
    text_ += "</components>\n</object>\n";
  }

  /// `copy` is null for an object where it is, without a name.
  void add_item(std::int64_t id, const PlacedCopy* copy) {
    text_ += "<item";
    append_attribute(text_, "objectid", id);
    if (copy) {
      text_ += " partnumber=\"" + escaped_xml(copy->name) + "\" transform=\"";
      // Row vectors are multiplied from the left: the columns of ours one after the other.
      for (const double entry : copy->rotation.reshaped()) {
        append_number(text_, entry);
        text_ += ' ';
      }
      for (int axis = 0; axis < 3; ++axis) {
        append_number(text_, copy->translation[axis]);
        text_ += axis < 2 ? " " : "\"";
      }
    }
    text_ += "/>\n";
  }

  std::string text_;
  std::int64_t last_id_ = 0;
};

}  // namespace

Shape read_three_mf_model(const Source& source) {
  return ThreeMfAssembler(source, nullptr, "", parse_model(source, "")).assemble();
}

Shape read_three_mf(const Source& source) {
  const ZipReader archive(source);
  const std::string entry = model_entry(archive);
  const std::optional<std::string> text = archive.entry(entry);
  if (!text) throw InputError(source.name + ": expected the entry " + in_quotes(entry) + " in the archive");
  return ThreeMfAssembler(source, &archive, entry, parse_model({*text, source.name}, entry)).assemble();
}

std::string write_three_mf(const Copies& copies) {
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
  return zip({{"[Content_Types].xml", types},
              {"_rels/.rels", relationships},
              {default_model, ModelWriter().write(copies)}});
}

}  // namespace stackabilization
