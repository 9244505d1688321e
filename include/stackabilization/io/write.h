#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "stackabilization/core/copies.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/io/format.h"

namespace stackabilization {

/// Where a format offers both (PLY, STL, VTP); the others ignore it.
enum class Encoding { binary, ascii };

/// How `write_shape` writes a mesh.
struct WriteOptions {
  std::optional<Format> format;          ///< Default: by extension. Standard output needs it.
  Encoding encoding = Encoding::binary;  ///< Binary or ascii text, where the format has both.
};

/// Writes a mesh file under a temporary name and renames it, so that no half file is ever seen; `path` "-" is
/// standard output. The same shape gives the same bytes.
///
/// What survives: OBJ, PLY and 3MF keep parts; OBJ, OFF, PLY, ascii STL, 3MF and VTP keep every double;
/// binary STL and GLB hold single precision. 3MF keeps the unit (`unknown` becomes millimetre, its default,
/// and so on reading back) and gives every part its own vertices. GLB turns z up into y up and lengths into
/// metres, as its specification wants; numbers of an `unknown` unit stay as they are. VTP carries the part
/// index as cell data "part".
///
/// Throws InputError when `shape` is invalid, UsageError when the format is missing or unknown, and
/// OutputError when the file cannot be written or a coordinate does not fit the format.
void write_shape(const Shape& shape, const std::filesystem::path& path, const WriteOptions& options = {});

/// The bytes of that file; `options.format` is not used.
std::string shape_bytes(const Shape& shape, Format format, const WriteOptions& options = {});

/// The same for copies of a shape. 3MF and GLB hold its meshes once and a placement for each copy, 3MF as
/// items of the build (`partnumber` is the name), GLB as nodes; the other formats, and these beyond what
/// `read_shape` takes from placements, hold `as_one_shape(copies)`.
///
/// Reading gives `as_one_shape(copies)` again: from 3MF, whose numbers are decimal and bring back each
/// double, to the bit; from GLB with the vertices of one copy in single precision and placements in double,
/// so that all copies are the same shape.
void write_shape(const Copies& copies, const std::filesystem::path& path, const WriteOptions& options = {});
/// The bytes of that file.
std::string shape_bytes(const Copies& copies, Format format, const WriteOptions& options = {});

}  // namespace stackabilization
