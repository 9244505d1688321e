#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/formats/json_node.h"
#include "stackabilization/deformation/deformation_model.h"

// The JSON form of edits, in histories and in saved searches; history.h describes it.
namespace stackabilization::detail {

nlohmann::ordered_json to_json(const Eigen::Vector3d& vector);

/// Throws InputError when the edit names a part that is no row of `part_names`.
nlohmann::ordered_json to_json(const Edit& edit, const std::vector<std::string>& part_names);

/// Returns the name of a part. Throws InputError when it is no row of `part_names`.
const std::string& name_of_part(int part, const std::vector<std::string>& part_names);

/// Reads a vector that a Direction accepts. Throws InputError naming the place.
Eigen::Vector3d direction_from_json(const JsonNode& node);

/// Reads an edit of the shape `rest` with a model that is able to do this. Throws InputError naming the
/// place, for parts and handles that the shape does not have and under the conditions of `validate`. How many
/// wires there are is not known here.
Edit edit_from_json(const JsonNode& node, const StructuredShape& rest,
                    const DeformationCapabilities& capabilities);

}  // namespace stackabilization::detail
