#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <sstream>
#include <utility>

#include "io/formats/bytes.h"
#include "io/formats/formats.h"
#include "io/formats/gltf_model.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

/// Model under construction for writing: one buffer.
class GlbWriter {
 public:
  std::string write(const Copies& copies) {
    model_.asset.version = "2.0";
    model_.asset.generator = "Stackabilization";
    model_.buffers.emplace_back();
    model_.scenes.emplace_back();
    model_.defaultScene = 0;
    std::vector<MeshRange> meshes;
    for (const Shape& shape : copies.shapes) meshes.push_back(add_meshes(shape));
    if (copies.placed.empty()) model_.scenes[0].nodes = add_nodes(meshes.front(), "");
    const double metres = metres_per_unit(copies.shapes.front().unit);
    for (const PlacedCopy& copy : copies.placed) add_copy(copy, meshes[copy.shape], metres);
    model_.buffers[0].data.assign(bytes_.begin(), bytes_.end());
    std::ostringstream stream;
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&model_, stream, false, true))
      throw OutputError("a GLB file cannot be composed");
    return std::move(stream).str();
  }

 private:
  /// Meshes of a shape: the first one, and the one behind the last.
  struct MeshRange {
    std::size_t first, last;
  };

  MeshRange add_meshes(const Shape& shape) {
    const std::size_t first = model_.meshes.size();
    const std::vector<PartMesh> parts = split_by_part(shape);
    for (std::size_t part = 0; part < parts.size(); ++part)
      if (!parts[part].triangles.empty())
        add_mesh(shape, parts[part], printable_name(shape.part_names[part]));
    return {first, model_.meshes.size()};
  }

  void add_mesh(const Shape& shape, const PartMesh& part, const std::string& name) {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = add_positions(shape, part);
    primitive.indices = add_indices(part);
    tinygltf::Mesh mesh;
    mesh.name = name;
    mesh.primitives.push_back(primitive);
    model_.meshes.push_back(mesh);
  }

  /// A node for each mesh, `prefix` before its name; their numbers.
  std::vector<int> add_nodes(const MeshRange& meshes, const std::string& prefix) {
    std::vector<int> added;
    for (std::size_t mesh = meshes.first; mesh < meshes.last; ++mesh) {
      tinygltf::Node node;
      node.name = prefix + model_.meshes[mesh].name;
      node.mesh = static_cast<int>(mesh);
      added.push_back(static_cast<int>(model_.nodes.size()));
      model_.nodes.push_back(node);
    }
    return added;
  }

  /// A node with the placement, the meshes below it.
  void add_copy(const PlacedCopy& copy, const MeshRange& meshes, double metres) {
    Eigen::Matrix3d turn;  // z up becomes y up
    turn << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    Eigen::Affine3d placement = Eigen::Affine3d::Identity();
    placement.linear() = turn * copy.rotation * turn.transpose();
    placement.translation() = turn * (metres * copy.translation);
    tinygltf::Node node;
    node.name = printable_name(copy.name);
    for (const double entry : placement.matrix().reshaped()) node.matrix.push_back(entry + 0.0);
    node.children = add_nodes(meshes, node.name + "/");
    model_.scenes[0].nodes.push_back(static_cast<int>(model_.nodes.size()));
    model_.nodes.push_back(node);
  }

  int add_positions(const Shape& shape, const PartMesh& part) {
    const std::size_t start = bytes_.size();
    Eigen::Array3d lower = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Array3d upper = -lower;
    const double metres = metres_per_unit(shape.unit);
    for (const std::int32_t v : part.vertices) {
      // z up becomes y up.
      const Eigen::Array3d turned =
          metres * Eigen::Array3d(shape.vertices(v, 0), shape.vertices(v, 2), 0 - shape.vertices(v, 1));
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

std::string write_glb(const Copies& copies) {
  return GlbWriter().write(copies);
}

}  // namespace stackabilization
