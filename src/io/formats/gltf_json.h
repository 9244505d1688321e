#pragma once

#include <string_view>

namespace stackabilization {

/// Returns the JSON text of a .gltf or .glb file.
std::string_view gltf_json(std::string_view bytes);

/// Returns whether the nesting of a JSON text is so deep that a recursive parser would overflow its stack.
bool is_deeply_nested(std::string_view json);

}  // namespace stackabilization
