#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "stackabilization/structure/segmentation.h"

namespace stackabilization {

/// Marked triangles from a text: a line holds the name of a part, one word, and triangles of `shape`,
/// 0-based, that belong to it. Parts come in order of first use; a part that occurs again gets further
/// triangles. Blank lines and `#` comments are skipped. Throws InputError naming `name` and the line for
/// anything else, for a triangle that does not exist or that is listed twice, and when there is no part.
std::vector<PartSeeds> parse_seeds(std::string_view text, const std::string& name, const Shape& shape);

/// The same with the text of a file.
std::vector<PartSeeds> read_seeds(const std::filesystem::path& path, const Shape& shape);

}  // namespace stackabilization
