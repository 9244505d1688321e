#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Files of the program of the paper's authors, beside an OBJ file. Their `.seg` files are part labels
/// (labels.h).
struct CtrlGrpFiles {
  std::optional<std::filesystem::path> controls;  ///< `.ctrl`: primitives of parts
  std::optional<std::filesystem::path> groups;    ///< `.grp`: relations between parts
};

/// A text and what messages call it.
struct NamedText {
  std::string_view text;  ///< all of it; empty: no file
  std::string name;       ///< such as the path of its file
};

/// Structure of `shape` from those files, in the frame of `shape`; their own numbers are in the frame in
/// which the box around the shape has its centre at the origin and a diagonal of 2.
///
/// * Parts that the `.ctrl` file does not have are fitted (`fit_primitive`); fit errors are measured for all.
/// * A symmetric pair is mirrored in the plane midway between the centres of its primitives.
/// * A cuboid's self-symmetries are the planes through its centre with the normals given; where older files
/// give none,
///   those across its axes that its surface satisfies best. Of a cylinder's only their number counts: one is
///   the plane of its curve, two make it a body of revolution.
/// * The numbers are not quite symmetric: the result is made so (`symmetrize`), planes that nearly agree with
/// each other or
///   with a symmetry found on the shape becoming one.
/// * A shape of one part is that part, whatever the files call it.
///
/// Throws InputError, naming file, line and what was expected, for damaged files, parts that do not exist and
/// relations that contradict each other.
Structure read_ctrl_grp(const Shape& shape, const CtrlGrpFiles& files);

/// The same from texts; empty ones stand for no file.
Structure parse_ctrl_grp(const Shape& shape, const NamedText& controls, const NamedText& groups);

}  // namespace stackabilization
