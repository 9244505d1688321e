#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// `shape` with its parts replaced by labels, one per triangle in the order of the triangles. Two kinds of
/// text:
///
/// * `.seg` of the authors' data: number of parts; optionally a line `labels name1 .. nameN`; then a line
///   `triangle part` for each triangle, both 0-based, in any order. Without names, parts are called "part_0"
///   and on;
/// * plain: one line per triangle with a part name or a 0-based index. Parts come in order of first use; when
/// every
///   label is an integer they are called "part_I" and come in order of I.
///
/// Lines are trimmed; blank lines and `#` comments are skipped; a line of two integers after a first line of
/// one says that the text is `.seg`. Throws InputError naming `name` and the line when a triangle has no
/// label or two, or a label is out of range.
Shape with_labels(Shape shape, std::string_view text, const std::string& name);

/// The same with the text of a file.
Shape with_labels(Shape shape, const std::filesystem::path& path);

}  // namespace stackabilization
