#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "stackabilization/core/copies.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/io/format.h"

namespace stackabilization {

/// Encoding of formats that have two (PLY, STL, VTP); other formats ignore it.
enum class Encoding { binary, ascii };

/// Options of `write_shape`.
struct WriteOptions {
  std::optional<Format> format;          ///< default: by extension; required for standard output
  Encoding encoding = Encoding::binary;  ///< binary or ascii, for formats that have both
};

/// Writes a mesh file atomically: under a temporary name that is then renamed. `path` "-" is standard output.
/// The same shape gives the same bytes.
///
/// Formats differ in what they preserve. OBJ, PLY and 3MF preserve parts. OBJ, OFF, PLY, ascii STL, 3MF and
/// VTP preserve every double; binary STL and GLB have single precision. 3MF preserves the unit and gives
/// every part its own vertices. `unknown` becomes millimetre, the default unit of 3MF, and is read back as
/// such. GLB converts z up to y up and lengths to metres, as its specification demands; numbers of an
/// `unknown` unit are unchanged. VTP has the part index as cell data "part".
///
/// Throws InputError when `shape` is invalid, UsageError when the format is missing or unknown, and
/// OutputError when the file cannot be written or a coordinate does not fit the format.
void write_shape(const Shape& shape, const std::filesystem::path& path, const WriteOptions& options = {});

/// Returns the bytes of that file. `options.format` is ignored.
std::string shape_bytes(const Shape& shape, Format format, const WriteOptions& options = {});

/// Writes copies of shapes. 3MF and GLB contain the meshes of a shape once and a placement for each copy: 3MF
/// as items of the build (`partnumber` is the name), GLB as nodes. The other formats contain
/// `as_one_shape(copies)`, and so do 3MF and GLB when there are more placements than `read_shape` accepts.
///
/// Reading the file gives `as_one_shape(copies)`. With 3MF the result is identical, because its decimal
/// numbers preserve doubles. With GLB the vertices of one copy have single precision and the placements
/// double precision, so that all copies have the same shape.
void write_shape(const Copies& copies, const std::filesystem::path& path, const WriteOptions& options = {});
/// Returns the bytes of that file.
std::string shape_bytes(const Copies& copies, Format format, const WriteOptions& options = {});

}  // namespace stackabilization
