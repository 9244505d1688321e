#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "io/formats/bytes.h"
#include "io/formats/formats.h"
#include "io/formats/gltf_model.h"
#include "io/formats/shape_builder.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

/// Walks the nodes of the default scene.
class GltfAssembler {
 public:
  GltfAssembler(const Source& source, const tinygltf::Model& model)
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

  Eigen::Affine3d transform_of(int index) const {
    const tinygltf::Node& node = item(model_.nodes, index, "node");
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
      const double length = rotation.coeffs().stableNorm();
      if (!std::isnormal(length)) fail("node " + std::to_string(index) + " has a rotation of no length");
      transform.rotate(Eigen::Quaterniond(rotation.coeffs() / length));
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
    const Eigen::Affine3d transform = outer * transform_of(index);
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

  /// Location of the elements of an accessor; all of them are inside their buffer.
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
        component_size <= 0)
      fail(what + " is not of the expected type");
    const std::size_t element_size =
        static_cast<std::size_t>(component_size) * static_cast<std::size_t>(components);
    if (stride < static_cast<int>(element_size))
      fail(what + " has elements of " + std::to_string(element_size) +
           " bytes, which do not fit the stride of its buffer view");
    // Compared by subtraction, which a lying header cannot make overflow.
    if (view.byteOffset > bytes.size() || view.byteLength > bytes.size() - view.byteOffset)
      fail("buffer view " + std::to_string(accessor.bufferView) + " goes beyond its buffer of " +
           std::to_string(bytes.size()) + " bytes");
    const std::size_t room =
        accessor.byteOffset <= view.byteLength ? view.byteLength - accessor.byteOffset : 0;
    const std::size_t fitting =
        room < element_size ? 0 : (room - element_size) / static_cast<std::size_t>(stride) + 1;
    if (accessor.count > fitting)
      fail(what + " states " + std::to_string(accessor.count) + " elements, its buffer view has room for " +
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
    if (builder_.face_count() > std::max(max_instanced_triangles, stored_limit()))
      fail("its nodes make more than " + std::to_string(max_instanced_triangles) + " triangles");
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

}  // namespace

Shape read_gltf(const Source& source, const std::optional<std::filesystem::path>& folder) {
  const tinygltf::Model model = parse_gltf(source, folder);
  return GltfAssembler(source, model).assemble();
}

}  // namespace stackabilization
