#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "stackabilization/core/shape.h"
#include "stackabilization/io/format.h"

namespace stackabilization {

/// A coordinate axis of a file.
enum class Axis { x, y, z };

/// Options of `read_shape` that replace information of the file.
struct ReadOptions {
  /// Format of the file. Default: by extension; for standard input by content.
  std::optional<Format> format;
  /// Unit of the coordinates. Numbers are not converted. Default: the unit in the file.
  std::optional<Unit> unit;
  /// Up axis of the file. It becomes z by an exact rotation of the axes (x: (x,y,z) -> (-z,y,x); y: (x,y,z)
  /// -> (x,-z,y)). Default: y for glTF, as its specification demands, z for every other format.
  std::optional<Axis> up;
  /// File of part labels that replace the parts of the mesh file: see labels.h.
  std::optional<std::filesystem::path> labels;
};

/// Reads a mesh file; `path` "-" is standard input. The result satisfies the invariants of Shape and has at
/// least one triangle. Its coordinates are exactly the doubles in the file; decimal numbers are rounded to
/// nearest.
///
/// Vertices keep their order, including vertices that no triangle uses. STL has no shared vertices, so
/// corners with equal coordinates become one vertex. Faces keep their order. Polygons are cut into triangles
/// of the same orientation, without new vertices.
///
/// Parts come in the order of their first face. They are
///
/// * the groups of OBJ (`g`, inside `o` objects: "object/group"; several names are joined by blanks; a
///   repeated name continues its part),
/// * the solids of STL,
/// * the objects of 3MF, one part per build item, with transforms applied,
/// * the meshes of glTF, one part per node, with transforms applied,
/// * one part, "part", for a file without parts.
///
/// Empty parts are dropped. Names must be UTF-8, since JSON and XML files contain them.
///
/// Throws InputError, one sentence with the file and the line, byte or element. The file may be missing,
/// unreadable, of unknown format, damaged or without faces, or may contain a number that is not finite in
/// double precision.
Shape read_shape(const std::filesystem::path& path, const ReadOptions& options = {});

/// Reads a mesh from memory. `name` is its name in messages. `options.format` is ignored. A glTF file must
/// contain its buffers.
Shape read_shape(std::string_view bytes, Format format, const std::string& name,
                 const ReadOptions& options = {});

}  // namespace stackabilization
