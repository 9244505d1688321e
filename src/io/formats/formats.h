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

// Readers: the whole file in, in the axes of the file; InputError as read.h promises.

Shape read_obj(const Source& source);
Shape read_off(const Source& source);
Shape read_ply(const Source& source);
Shape read_stl(const Source& source);
Shape read_three_mf(const Source& source);
/// `folder` is where the file's external buffers lie; without one they are refused.
Shape read_gltf(const Source& source, const std::optional<std::filesystem::path>& folder);

/// Whether the size of a file is what its binary STL header states.
bool is_binary_stl(std::string_view bytes);

/// The model inside a 3MF archive, for the fuzzer: one XML text without references to others.
Shape read_three_mf_model(const Source& source);

// Writers: a valid shape in, the whole file out; OutputError where a coordinate does not fit.

std::string write_obj(const Shape& shape);
std::string write_off(const Shape& shape);
std::string write_ply(const Shape& shape, Encoding encoding);
std::string write_stl(const Shape& shape, Encoding encoding);
/// `copies` is empty for the shape itself, without a name of its own.
std::string write_three_mf(const Shape& shape, const std::vector<PlacedCopy>& copies = {});
std::string write_glb(const Shape& shape, const std::vector<PlacedCopy>& copies = {});
std::string write_vtp(const Shape& shape, Encoding encoding);

/// Rows of the triangles of every part, in their order.
std::vector<std::vector<Eigen::Index>> triangles_by_part(const Shape& shape);

/// A part with vertices of its own: rows of the shape's vertices, and triangles of indices into those.
struct PartMesh {
  std::vector<std::int32_t> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;
};

/// One mesh per part.
std::vector<PartMesh> split_by_part(const Shape& shape);

/// Instances of formats with instancing may not blow a file up beyond this, unless it stores as many itself.
inline constexpr std::int64_t max_instanced_triangles = 20000000;

/// A few nested components can multiply without bounds; no real assembly comes near this.
inline constexpr std::int64_t max_placed_objects = 100000;

/// `name` on one line: control characters become '_'.
std::string printable_name(const std::string& name);

/// `text` as the value of an XML attribute in double quotes, on one line.
std::string escaped_xml(const std::string& text);

/// `value` in single precision. Throws OutputError naming `format` when it is too large for that.
float to_single(double value, const char* format);

}  // namespace stackabilization
