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

/// What `read_shape` takes instead of what the file says about itself.
struct ReadOptions {
  /// Default: by extension; for standard input by content.
  std::optional<Format> format;
  /// Unit of the coordinates, instead of what the file states. Numbers are relabelled, not converted.
  std::optional<Unit> unit;
  /// Axis of the file that points up; it becomes z by an exact rotation of the axes (x: (x,y,z) -> (-z,y,x);
  /// y: (x,y,z) -> (x,-z,y)). Default: y for glTF, as its specification fixes, z for every other format.
  std::optional<Axis> up;
  /// Part labels, one per triangle, that replace the parts of the file: see labels.h.
  std::optional<std::filesystem::path> labels;
};

/// Reads a mesh file; `path` "-" is standard input. The result satisfies the invariants of Shape, has at
/// least one triangle, and holds exactly the doubles that the file states (decimal numbers rounded to
/// nearest).
///
/// Vertices keep their order, also those that no triangle uses; STL has no vertices of its own, so corners
/// with equal coordinates become one. Faces keep their order; polygons are cut into triangles of the same
/// orientation, without new vertices. Parts come in the order of their first face: OBJ groups (`g`, inside
/// `o` objects: "object/group"; several names are one, joined by blanks; a name that opens again goes on),
/// STL solids, 3MF objects per build item and glTF meshes per node, transforms applied; a file without parts
/// has one, "part". Empty parts vanish. Names are UTF-8, or the file is refused: they go on into JSON and
/// XML, which hold nothing else.
///
/// Throws InputError, one sentence with the file and the line, byte or element, when the file is missing,
/// unreadable, of unknown kind, damaged, has a number that is not finite in double precision, or has no
/// faces.
Shape read_shape(const std::filesystem::path& path, const ReadOptions& options = {});

/// The same for a file in memory; `name` is what messages call it. `options.format` is not used. A glTF file
/// must carry its buffers inside.
Shape read_shape(std::string_view bytes, Format format, const std::string& name,
                 const ReadOptions& options = {});

}  // namespace stackabilization
