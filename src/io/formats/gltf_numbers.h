#pragma once

#include <string>
#include <string_view>

namespace stackabilization {

/// Checks every number of the JSON of a glTF file that reading it uses, because tinygltf takes what is
/// negative, broken or not a number for absent, and cuts what is too large. Throws InputError naming the file
/// `name`, the place as JSON pointer, what was expected and what was found. Text that is no JSON is left
/// alone.
void check_gltf_numbers(std::string_view text, const std::string& name);

}  // namespace stackabilization
