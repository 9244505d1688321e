#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Files that the program of the paper's authors writes beside an OBJ file. The authors' `.seg` files are
/// part labels; labels.h reads them.
struct CtrlGrpFiles {
  std::optional<std::filesystem::path> controls;  ///< `.ctrl`: primitives of parts
  std::optional<std::filesystem::path> groups;    ///< `.grp`: relations between parts
};

/// A text and its name in messages.
struct NamedText {
  std::string_view text;  ///< the whole text; empty when there is no file
  std::string name;       ///< name in messages, such as the path of the file
};

/// Reads the structure of `shape` from the authors' files. The result is in the frame of `shape`. The numbers
/// in the files are in another frame: the bounding box of the shape has its centre at the origin and a
/// diagonal of 2.
///
/// * Parts without an entry in the `.ctrl` file are fitted by `fit_primitive`. Fit errors are measured for
///   all parts.
/// * The mirror plane of a symmetric pair is the plane midway between the centres of its two primitives.
/// * The self-symmetries of a cuboid are the planes through its centre with the normals in the file. Older
///   files contain no normals; the function then takes the planes across the axes of the cuboid with the
///   smallest residuals on its surface.
/// * Of the self-symmetries of a cylinder, only their number is used. One is a reflection in the plane of the
///   curve; two describe a body of revolution.
/// * The numbers in the files are only nearly symmetric. The result is symmetrized (`symmetrize`). Planes
/// that
///   nearly agree with each other, or with a symmetry found on the shape, become one plane.
/// * A shape with one part is that part, whatever its name in the files.
///
/// Throws InputError, naming the file, the line and the expected content, for damaged files, for parts that
/// do not exist, and for relations that contradict each other.
Structure read_ctrl_grp(const Shape& shape, const CtrlGrpFiles& files);

/// Computes the same structure from texts. An empty text stands for a missing file.
Structure parse_ctrl_grp(const Shape& shape, const NamedText& controls, const NamedText& groups);

}  // namespace stackabilization
