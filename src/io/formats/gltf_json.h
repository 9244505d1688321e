#pragma once

#include <string_view>

namespace stackabilization {

/// The JSON text of a .gltf or .glb file.
std::string_view gltf_json(std::string_view bytes);

/// Is JSON text nested so deeply that a parser that descends by recursion would overflow its stack?
bool is_deeply_nested(std::string_view json);

}  // namespace stackabilization
