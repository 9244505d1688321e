#pragma once

#include <string>
#include <string_view>

namespace stackabilization {

/// Checks all numbers in the JSON of a glTF file that the reader uses. tinygltf treats negative, fractional
/// and non-numeric values as absent, and truncates large ones. Throws InputError with the file `name`, the
/// place as JSON pointer, the expected value and the actual value. Accepts text that is not JSON.
void check_gltf_numbers(std::string_view text, const std::string& name);

}  // namespace stackabilization
