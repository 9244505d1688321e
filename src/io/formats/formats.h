#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "stackabilization/core/copies.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/core/text.h"
#include "stackabilization/io/write.h"

namespace stackabilization {

// Readers: they take a whole file and return the shape in the axes of the file. They throw InputError as in
// read.h.

Shape read_obj(const Source& source);
Shape read_off(const Source& source);
Shape read_ply(const Source& source);
Shape read_stl(const Source& source);
Shape read_three_mf(const Source& source);
/// Reads glTF. `folder` contains the external buffers of the file; without it they are refused.
Shape read_gltf(const Source& source, const std::optional<std::filesystem::path>& folder);

/// Returns whether the size of a file matches its binary STL header.
bool is_binary_stl(std::string_view bytes);

/// Reads the model of a 3MF archive, for the fuzzer: one XML text without references to others.
Shape read_three_mf_model(const Source& source);

// Writers: they take a valid shape and return the whole file. They throw OutputError when a coordinate does
// not fit.

std::string write_obj(const Shape& shape);
std::string write_off(const Shape& shape);
std::string write_ply(const Shape& shape, Encoding encoding);
std::string write_stl(const Shape& shape, Encoding encoding);
/// Writes 3MF. Without placed copies, here and for GLB: the first shape itself, without a name.
std::string write_three_mf(const Copies& copies);
std::string write_glb(const Copies& copies);
std::string write_vtp(const Shape& shape, Encoding encoding);

/// Returns the rows of the triangles of every part, ascending.
std::vector<std::vector<Eigen::Index>> triangles_by_part(const Shape& shape);

/// A part with its own vertices.
struct PartMesh {
  std::vector<std::int32_t> vertices;                  ///< rows of the vertices of the shape
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< indices into `vertices`
};

/// Returns one mesh per part.
std::vector<PartMesh> split_by_part(const Shape& shape);

/// Limit of the number of triangles after instancing, unless the file itself stores as many.
inline constexpr std::int64_t max_instanced_triangles = 20000000;

/// Limit of the number of placed objects: nested components can multiply without bound.
inline constexpr std::int64_t max_placed_objects = 100000;

/// Returns `name` on one line, with '_' in place of control characters.
std::string printable_name(const std::string& name);

/// Returns `text` as the value of an XML attribute in double quotes, on one line.
std::string escaped_xml(const std::string& text);

/// Rounds `value` to single precision. Throws OutputError, naming `format`, when it is too large.
float to_single(double value, const char* format);

}  // namespace stackabilization
