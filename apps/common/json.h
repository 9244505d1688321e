#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/core/rational.h"
#include "stackabilization/envelope/contacts.h"
#include "stackabilization/envelope/separation.h"
#include "stackabilization/envelope/separation_gradient.h"
#include "stackabilization/io/inspect.h"

/// The library's values as JSON. Keys keep their order; doubles print with as many digits as bring them back
/// exactly; what is not finite becomes null.
namespace stackabilization::apps {

using Json = nlohmann::ordered_json;

Json to_json(const Eigen::Vector3d& vector);
Json to_json(const Eigen::Matrix3d& matrix);  ///< rows
Json to_json(const Rational& value);          ///< {"numerator": "...", "denominator": "..."}
Json to_json(Unit unit);                      ///< "mm", or null
Json to_json(const Witness& witness);
Json to_json(const SeparationGradients& gradients);
Json to_json(const Findings& findings);
Json to_json(const std::vector<ContactRegion>& regions, const std::vector<std::string>& part_names);

template <class Value>
Json to_json(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

/// The document as indented text with a line end. All text in it is UTF-8: part names are where they are
/// read, and paths where the command line is.
std::string json_text(const Json& document);

}  // namespace stackabilization::apps
