#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "stackabilization/structure/segmentation.h"

namespace stackabilization {

/// Parses seeds. A line consists of the name of a part (one word) and 0-based triangles of `shape` that
/// belong to it. Parts come in the order of first use. Further lines of the same name add triangles. Blank
/// lines and `#` comments are skipped. Throws InputError, with `name` and the line, for any other content,
/// for a triangle that does not exist or is listed twice, and when there is no part.
std::vector<PartSeeds> parse_seeds(std::string_view text, const std::string& name, const Shape& shape);

/// Reads seeds from a file.
std::vector<PartSeeds> read_seeds(const std::filesystem::path& path, const Shape& shape);

}  // namespace stackabilization
