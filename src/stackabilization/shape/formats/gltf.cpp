// tinygltf is compiled here, once, without its own image decoders and file access. It forgets to include
// <fstream>.
#include <fstream>
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_FS
#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <sstream>
#include <utility>

#include "stackabilization/shape/errors.h"
#include "stackabilization/shape/formats/bytes.h"
#include "stackabilization/shape/formats/formats.h"
#include "stackabilization/shape/formats/shape_builder.h"
#include "stackabilization/shape/read_file.h"

namespace stackabilization {

namespace {

using Folder = std::optional<std::filesystem::path>;

/// tinygltf descends into nested JSON by recursion, so that text without end would overflow its stack.
bool is_deeply_nested(std::string_view bytes) {
  constexpr int deepest = 200;
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const char c = bytes[i];
    if (in_string && c == '\\') ++i;
    if (c == '"') in_string = !in_string;
    if (in_string) continue;
    if (c == '{' || c == '[') ++depth;
    if (c == '}' || c == ']') --depth;
    if (depth > deepest) return true;
  }
  return false;
}

/// The JSON text of either kind of file.
std::string_view json_of(std::string_view bytes) {
  constexpr std::size_t start = 20;
  if (!bytes.starts_with("glTF") || bytes.size() < start) return bytes;
  return bytes.substr(start, load<std::uint32_t>(bytes.data() + 12, std::endian::little));
}

/// File access for tinygltf; the user pointer is the folder of the file.
template <class Callbacks>
Callbacks file_callbacks(const Folder& folder) {
  Callbacks callbacks{};
  callbacks.FileExists = [](const std::string& path, void*) {
    return std::filesystem::is_regular_file(path);
  };
  callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
  callbacks.ReadWholeFile = [](std::vector<unsigned char>* bytes, std::string* error, const std::string& path,
                               void*) {
    try {
      const std::string text = read_file(path);
      bytes->assign(text.begin(), text.end());
      return true;
    } catch (const InputError& reason) {
      *error += reason.what();
      return false;
    }
  };
  if constexpr (requires { callbacks.GetFileSizeInBytes; })
    callbacks.GetFileSizeInBytes = [](std::size_t* size, std::string*, const std::string& path, void*) {
      std::error_code error;
      *size = static_cast<std::size_t>(std::filesystem::file_size(path, error));
      return !error;
    };
  if (!folder) callbacks.FileExists = [](const std::string&, void*) { return false; };
  return callbacks;
}

tinygltf::Model parse(const Source& source, const Folder& folder) {
  if (source.bytes.size() > std::numeric_limits<std::uint32_t>::max())
    throw InputError(source.name + ": glTF files hold at most 4 GiB");
  if (is_deeply_nested(json_of(source.bytes)))
    throw InputError(source.name + ": its JSON is nested without end");
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader([](tinygltf::Image*, const int, std::string*, std::string*, int, int,
                           const unsigned char*, int, void*) { return true; },
                        nullptr);
  loader.SetFsCallbacks(file_callbacks<tinygltf::FsCallbacks>(folder));
  tinygltf::Model model;
  std::string error;
  std::string warning;
  const std::string base = folder ? folder->string() : "";
  const auto length = static_cast<unsigned>(source.bytes.size());
  const bool good =
      source.bytes.starts_with("glTF")
          ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                        reinterpret_cast<const unsigned char*>(source.bytes.data()), length,
                                        base)
          : loader.LoadASCIIFromString(&model, &error, &warning, source.bytes.data(), length, base);
  if (good) return model;
  std::replace(error.begin(), error.end(), '\n', ' ');
  error.erase(error.find_last_not_of(' ') + 1);
  throw InputError(source.name + ": expected a glTF 2.0 file with its buffers: " +
                   (error.empty() ? "it cannot be parsed" : error));
}

/// Walks the nodes of the default scene.
class Assembler {
 public:
  Assembler(const Source& source, const tinygltf::Model& model)
      : name_(source.name), model_(model), visited_(model.nodes.size()), builder_(source.name) {}

  Shape assemble() {
    if (model_.scenes.empty())
      for (const int root : roots()) add_node(root, Eigen::Affine3d::Identity(), 0);
    else
      for (const int root : scene().nodes) add_node(root, Eigen::Affine3d::Identity(), 0);
    Shape shape = builder_.finish();
    shape.unit = Unit::metre;
    return shape;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw InputError(name_ + ": " + message); }

  /// Element `index` of a list of the file, checked.
  template <class Item>
  const Item& item(const std::vector<Item>& items, int index, const char* what) const {
    if (index < 0 || static_cast<std::size_t>(index) >= items.size())
      fail(std::string("expected a ") + what + " below " + std::to_string(items.size()) + ", found " +
           std::to_string(index));
    return items[static_cast<std::size_t>(index)];
  }

  const tinygltf::Scene& scene() const {
    return item(model_.scenes, std::max(model_.defaultScene, 0), "scene");
  }

  std::vector<int> roots() const {
    std::vector<char> is_child(model_.nodes.size(), 0);
    for (const tinygltf::Node& node : model_.nodes)
      for (const int child : node.children)
        if (child >= 0 && static_cast<std::size_t>(child) < is_child.size())
          is_child[static_cast<std::size_t>(child)] = 1;
    std::vector<int> result;
    for (std::size_t i = 0; i < is_child.size(); ++i)
      if (!is_child[i]) result.push_back(static_cast<int>(i));
    return result;
  }

  static Eigen::Affine3d transform_of(const tinygltf::Node& node) {
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();
    if (node.matrix.size() == 16) {
      transform.matrix() = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
      transform.makeAffine();
      return transform;
    }
    if (node.translation.size() == 3) transform.translate(Eigen::Vector3d(node.translation.data()));
    if (node.rotation.size() == 4) {
      const Eigen::Quaterniond rotation(node.rotation[3], node.rotation[0], node.rotation[1],
                                        node.rotation[2]);
      if (rotation.norm() > 0) transform.rotate(rotation.normalized());
    }
    if (node.scale.size() == 3) transform.scale(Eigen::Vector3d(node.scale.data()));
    return transform;
  }

  void add_node(int index, const Eigen::Affine3d& outer, int depth) {
    const tinygltf::Node& node = item(model_.nodes, index, "node");
    constexpr int deepest = 1000;
    if (depth > deepest || std::exchange(visited_[static_cast<std::size_t>(index)], 1))
      fail("node " + std::to_string(index) +
           " has several parents or is nested without end, expected a tree");
    const Eigen::Affine3d transform = outer * transform_of(node);
    if (node.mesh >= 0) add_mesh(node, transform);
    for (const int child : node.children) add_node(child, transform, depth + 1);
  }

  void add_mesh(const tinygltf::Node& node, const Eigen::Affine3d& transform) {
    const tinygltf::Mesh& mesh = item(model_.meshes, node.mesh, "mesh");
    std::string name = node.name.empty() ? mesh.name : node.name;
    if (name.empty()) name = "mesh_" + std::to_string(node.mesh);
    builder_.begin_part(name);
    const bool mirrored = transform.linear().determinant() < 0;
    std::map<int, std::int64_t>
        first_vertex;  ///< By accessor: primitives of a mesh often share their positions.
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      const auto position = primitive.attributes.find("POSITION");
      if (position == primitive.attributes.end()) continue;
      const auto [entry, is_new] = first_vertex.try_emplace(position->second, builder_.vertex_count());
      if (is_new) add_positions(position->second, transform);
      add_triangles(primitive, entry->second, mirrored);
    }
  }

  /// Where the elements of an accessor lie; all of them inside their buffer.
  struct Elements {
    const char* start;
    std::size_t stride;
    std::size_t count;
    int component_type;
    bool normalized;
  };

  Elements elements(int index, int components) const {
    const std::string what = "accessor " + std::to_string(index);
    const tinygltf::Accessor& accessor = item(model_.accessors, index, "accessor");
    if (accessor.sparse.isSparse || accessor.bufferView < 0)
      fail(what + " is sparse or compressed, which is not supported");
    const tinygltf::BufferView& view = item(model_.bufferViews, accessor.bufferView, "buffer view");
    const std::vector<unsigned char>& bytes = item(model_.buffers, view.buffer, "buffer").data;
    const int stride = accessor.ByteStride(view);
    const int component_size =
        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType));
    if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) != components ||
        stride <= 0 || component_size <= 0)
      fail(what + " is not of the expected type");
    const std::size_t element_size =
        static_cast<std::size_t>(component_size) * static_cast<std::size_t>(components);
    // Compared by division and subtraction, which a lying header cannot make overflow.
    const std::size_t size = bytes.size();
    const bool starts_inside = view.byteOffset <= size && accessor.byteOffset <= size - view.byteOffset;
    const std::size_t room = starts_inside ? size - view.byteOffset - accessor.byteOffset : 0;
    const std::size_t fitting =
        room < element_size ? 0 : (room - element_size) / static_cast<std::size_t>(stride) + 1;
    if (accessor.count > fitting)
      fail(what + " states " + std::to_string(accessor.count) + " elements, its buffer has room for " +
           std::to_string(fitting));
    if (accessor.count == 0) return {nullptr, 0, 0, accessor.componentType, accessor.normalized};
    return {reinterpret_cast<const char*>(bytes.data()) + view.byteOffset + accessor.byteOffset,
            static_cast<std::size_t>(stride), accessor.count, accessor.componentType, accessor.normalized};
  }

  template <class Integer>
  static double quantized(const char* at, bool normalized) {
    const double value = load<Integer>(at, std::endian::little);
    return normalized ? std::max(value / std::numeric_limits<Integer>::max(), -1.0) : value;
  }

  double component(const Elements& elements, const char* at) const {
    switch (elements.component_type) {
      case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return load<float>(at, std::endian::little);
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return quantized<std::int8_t>(at, elements.normalized);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return quantized<std::uint8_t>(at, elements.normalized);
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return quantized<std::int16_t>(at, elements.normalized);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return quantized<std::uint16_t>(at, elements.normalized);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return quantized<std::uint32_t>(at, elements.normalized);
      default:
        fail("an accessor has component type " + std::to_string(elements.component_type) +
             ", expected numbers");
    }
  }

  void add_positions(int accessor, const Eigen::Affine3d& transform) {
    const Elements positions = elements(accessor, 3);
    const auto component_size = static_cast<std::size_t>(
        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(positions.component_type)));
    for (std::size_t v = 0; v < positions.count; ++v) {
      const char* const at = positions.start + v * positions.stride;
      Eigen::Vector3d point;
      for (std::size_t axis = 0; axis < 3; ++axis)
        point[static_cast<Eigen::Index>(axis)] = component(positions, at + axis * component_size);
      point = transform * point;
      if (!point.allFinite())
        fail("vertex " + std::to_string(v) + " of accessor " + std::to_string(accessor) +
             " has a coordinate that is not a finite number");
      builder_.add_vertex(point.x(), point.y(), point.z());
    }
  }

  std::vector<std::int32_t> corners(const tinygltf::Primitive& primitive, std::int64_t first_vertex) const {
    const std::int64_t vertex_count = builder_.vertex_count() - first_vertex;
    std::vector<std::int32_t> result;
    if (primitive.indices < 0) {
      const std::size_t count = elements(primitive.attributes.at("POSITION"), 3).count;
      for (std::size_t i = 0; i < count; ++i)
        result.push_back(static_cast<std::int32_t>(first_vertex + static_cast<std::int64_t>(i)));
      return result;
    }
    const Elements indices = elements(primitive.indices, 1);
    if (indices.component_type == TINYGLTF_COMPONENT_TYPE_FLOAT)
      fail("accessor " + std::to_string(primitive.indices) + " holds indices, expected integers");
    for (std::size_t i = 0; i < indices.count; ++i) {
      const double vertex = component(indices, indices.start + i * indices.stride);
      if (!(vertex >= 0 && vertex < static_cast<double>(vertex_count)))
        fail("accessor " + std::to_string(primitive.indices) + ": expected a vertex below " +
             std::to_string(vertex_count) + " at index " + std::to_string(i));
      result.push_back(static_cast<std::int32_t>(first_vertex + static_cast<std::int64_t>(vertex)));
    }
    return result;
  }

  /// Triangle lists, strips and fans; points and lines have no faces.
  void add_triangles(const tinygltf::Primitive& primitive, std::int64_t first_vertex, bool mirrored) {
    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    if (mode < TINYGLTF_MODE_TRIANGLES) return;
    const std::vector<std::int32_t> list = corners(primitive, first_vertex);
    const std::size_t step = mode == TINYGLTF_MODE_TRIANGLES ? 3 : 1;
    if (mode == TINYGLTF_MODE_TRIANGLES && list.size() % 3 != 0)
      fail("a primitive has " + std::to_string(list.size()) + " corners, expected a multiple of three");
    for (std::size_t i = 0; i + 2 < list.size(); i += step) {
      std::array<std::int32_t, 3> triangle = {list[i], list[i + 1], list[i + 2]};
      if (mode == TINYGLTF_MODE_TRIANGLE_FAN) triangle[0] = list[0];
      const bool every_other = mode == TINYGLTF_MODE_TRIANGLE_STRIP && i % 2 == 1;
      if (mirrored != every_other) std::swap(triangle[1], triangle[2]);
      builder_.add_face(triangle);
    }
    if (builder_.face_count() > std::max(most_instanced_triangles, stored_limit()))
      fail("its nodes make more than " + std::to_string(most_instanced_triangles) + " triangles");
  }

  /// Triangles that the buffers could hold without instancing: an index takes a byte or more.
  std::int64_t stored_limit() const {
    std::int64_t bytes = 0;
    for (const tinygltf::Buffer& buffer : model_.buffers)
      bytes += static_cast<std::int64_t>(buffer.data.size());
    return bytes / 3;
  }

  const std::string& name_;
  const tinygltf::Model& model_;
  std::vector<char> visited_;
  ShapeBuilder builder_;
};

/// Model under construction for writing: one buffer.
class GlbWriter {
 public:
  std::string write(const Shape& shape) {
    model_.asset.version = "2.0";
    model_.asset.generator = "Stackabilization";
    model_.buffers.emplace_back();
    model_.scenes.emplace_back();
    model_.defaultScene = 0;
    const std::vector<PartMesh> meshes = split_by_part(shape);
    for (std::size_t part = 0; part < meshes.size(); ++part)
      if (!meshes[part].triangles.empty())
        add_part(shape, meshes[part], printable_name(shape.part_names[part]));
    model_.buffers[0].data.assign(bytes_.begin(), bytes_.end());
    std::ostringstream stream;
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&model_, stream, false, true))
      throw OutputError("a GLB file cannot be composed");
    return std::move(stream).str();
  }

 private:
  void add_part(const Shape& shape, const PartMesh& part, const std::string& name) {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = add_positions(shape, part);
    primitive.indices = add_indices(part);
    tinygltf::Mesh mesh;
    mesh.name = name;
    mesh.primitives.push_back(primitive);
    tinygltf::Node node;
    node.name = name;
    node.mesh = static_cast<int>(model_.meshes.size());
    model_.scenes[0].nodes.push_back(static_cast<int>(model_.nodes.size()));
    model_.meshes.push_back(mesh);
    model_.nodes.push_back(node);
  }

  int add_positions(const Shape& shape, const PartMesh& part) {
    const std::size_t start = bytes_.size();
    Eigen::Array3d lower = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Array3d upper = -lower;
    for (const std::int32_t v : part.vertices) {
      // z up becomes y up.
      const Eigen::Array3d turned(shape.vertices(v, 0), shape.vertices(v, 2), 0 - shape.vertices(v, 1));
      const Eigen::Array3f point(to_single(turned.x(), "GLB"), to_single(turned.y(), "GLB"),
                                 to_single(turned.z(), "GLB"));
      for (const float coordinate : point) append_little(bytes_, coordinate);
      lower = lower.min(point.cast<double>());
      upper = upper.max(point.cast<double>());
    }
    const int index =
        add_accessor(start, part.vertices.size(), TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3);
    model_.accessors.back().minValues.assign(lower.begin(), lower.end());
    model_.accessors.back().maxValues.assign(upper.begin(), upper.end());
    model_.bufferViews.back().target = TINYGLTF_TARGET_ARRAY_BUFFER;
    return index;
  }

  int add_indices(const PartMesh& part) {
    const std::size_t start = bytes_.size();
    for (const std::array<std::int32_t, 3>& triangle : part.triangles)
      for (const std::int32_t vertex : triangle) append_little(bytes_, static_cast<std::uint32_t>(vertex));
    const int index = add_accessor(start, 3 * part.triangles.size(), TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                   TINYGLTF_TYPE_SCALAR);
    model_.bufferViews.back().target = TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER;
    return index;
  }

  /// Accessor and buffer view for what lies in the buffer from `start` on.
  int add_accessor(std::size_t start, std::size_t count, int component_type, int type) {
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = start;
    view.byteLength = bytes_.size() - start;
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model_.bufferViews.size());
    accessor.componentType = component_type;
    accessor.type = type;
    accessor.count = count;
    model_.bufferViews.push_back(view);
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  tinygltf::Model model_;
  std::string bytes_;
};

}  // namespace

Shape read_gltf(const Source& source, const Folder& folder) {
  const tinygltf::Model model = parse(source, folder);
  return Assembler(source, model).assemble();
}

std::string write_glb(const Shape& shape) {
  return GlbWriter().write(shape);
}

}  // namespace stackabilization
