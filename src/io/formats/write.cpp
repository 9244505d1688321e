#include "stackabilization/io/write.h"

#include <array>
#include <cmath>
#include <limits>

#include "io/formats/formats.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/io/write_file.h"

namespace stackabilization {

std::vector<std::vector<Eigen::Index>> triangles_by_part(const Shape& shape) {
  std::vector<std::vector<Eigen::Index>> members(shape.part_names.size());
  for (std::size_t t = 0; t < shape.triangle_part.size(); ++t)
    members[static_cast<std::size_t>(shape.triangle_part[t])].push_back(static_cast<Eigen::Index>(t));
  return members;
}

std::vector<PartMesh> split_by_part(const Shape& shape) {
  std::vector<PartMesh> meshes(shape.part_names.size());
  std::vector<std::int32_t> local(static_cast<std::size_t>(shape.vertex_count()), -1);
  const std::vector<std::vector<Eigen::Index>> members = triangles_by_part(shape);
  for (std::size_t part = 0; part < meshes.size(); ++part) {
    PartMesh& mesh = meshes[part];
    for (const Eigen::Index t : members[part]) {
      std::array<std::int32_t, 3>& triangle = mesh.triangles.emplace_back();
      for (int corner = 0; corner < 3; ++corner) {
        std::int32_t& vertex = local[static_cast<std::size_t>(shape.triangles(t, corner))];
        if (vertex < 0) {
          vertex = static_cast<std::int32_t>(mesh.vertices.size());
          mesh.vertices.push_back(shape.triangles(t, corner));
        }
        triangle[static_cast<std::size_t>(corner)] = vertex;
      }
    }
    for (const std::int32_t vertex : mesh.vertices) local[static_cast<std::size_t>(vertex)] = -1;
  }
  return meshes;
}

std::string printable_name(const std::string& name) {
  std::string result = name;
  for (char& c : result)
    if (static_cast<unsigned char>(c) < ' ') c = '_';
  return result;
}

std::string escaped_xml(const std::string& text) {
  std::string result;
  for (const char c : printable_name(text)) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  return result;
}

float to_single(double value, const char* format) {
  if (std::abs(value) > std::numeric_limits<float>::max())
    throw OutputError("the coordinate " + std::to_string(value) + " does not fit the single precision of " +
                      format);
  return static_cast<float>(value);
}

std::string shape_bytes(const Shape& shape, Format format, const WriteOptions& options) {
  validate(shape);
  switch (format) {
    case Format::obj:
      return write_obj(shape);
    case Format::off:
      return write_off(shape);
    case Format::ply:
      return write_ply(shape, options.encoding);
    case Format::stl:
      return write_stl(shape, options.encoding);
    case Format::three_mf:
      return write_three_mf({{shape}, {}});
    case Format::gltf:
      return write_glb({{shape}, {}});
    case Format::vtp:
      break;
  }
  return write_vtp(shape, options.encoding);
}

namespace {

/// Returns whether the copies can be read back from placements.
bool can_be_instanced(const Copies& copies) {
  std::int64_t objects = 0, triangles = 0;
  for (const PlacedCopy& copy : copies.placed) {
    objects += copies.shapes[copy.shape].part_count() + 1;
    triangles += copies.shapes[copy.shape].triangle_count();
  }
  return objects <= max_placed_objects && triangles <= max_instanced_triangles;
}

Format format_of_output(const std::filesystem::path& path, const WriteOptions& options) {
  std::optional<Format> format = options.format;
  if (!format) {
    if (path == "-") throw UsageError("writing a mesh to standard output needs a format");
    try {
      format = format_of_extension(path);
    } catch (const InputError& error) {
      throw UsageError(error.what());
    }
    if (lower_case(path.extension().string()) == ".gltf")
      throw UsageError(path.string() +
                       ": glTF is written in its binary form only, expected the extension .glb");
  }
  return *format;
}

}  // namespace

std::string shape_bytes(const Copies& copies, Format format, const WriteOptions& options) {
  if ((format != Format::three_mf && format != Format::gltf) || !can_be_instanced(copies))
    return shape_bytes(as_one_shape(copies), format, options);
  for (const Shape& shape : copies.shapes) validate(shape);
  return format == Format::three_mf ? write_three_mf(copies) : write_glb(copies);
}

void write_shape(const Shape& shape, const std::filesystem::path& path, const WriteOptions& options) {
  write_file_atomically(path, shape_bytes(shape, format_of_output(path, options), options));
}

void write_shape(const Copies& copies, const std::filesystem::path& path, const WriteOptions& options) {
  write_file_atomically(path, shape_bytes(copies, format_of_output(path, options), options));
}

}  // namespace stackabilization
