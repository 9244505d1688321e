#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Replaces the parts of `shape` by labels, one per triangle. Two kinds of text are accepted:
///
/// * `.seg` files of the authors: the number of parts; optionally a line `labels name1 .. nameN`; then a line
///   `triangle part` for each triangle, both 0-based, in any order. Without names, parts are called "part_0",
///   "part_1", ...
/// * plain text: one line per triangle, in the order of the triangles, with a part name or a 0-based index.
///   Parts come in the order of first use. When all labels are integers, parts are called "part_I" and come
///   in the order of I.
///
/// Lines are trimmed. Blank lines and `#` comments are skipped. A text is of the kind `.seg` when a line of
/// two integers follows a first line of one integer. Throws InputError, with `name` and the line, when a
/// triangle has no label or two labels, or a label is out of range.
Shape with_labels(Shape shape, std::string_view text, const std::string& name);

/// Replaces the parts by the labels of a file.
Shape with_labels(Shape shape, const std::filesystem::path& path);

}  // namespace stackabilization
