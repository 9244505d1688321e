#pragma once

#include <string>

#include "apps/common/json.h"
#include "apps/common/model.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization::apps {

/// "cuboid" or "cylinder", as on the command line.
std::string kind_of(const Primitive& primitive);

/// {kind, corners} or {kind, centres, radii, closed}: what brings the primitive back.
Json to_json(const Primitive& primitive);

/// {plane: {point, normal}} or {axis: {point, direction, order}}; the order of a revolution is "revolution".
Json to_json(const Symmetry& symmetry);

/// {type, parts, plane or axis or points, residual}.
Json to_json(const Relation& relation, const Structure& structure);

/// {diagonal, parts, primitives, symmetries, relations}.
void add_structure(Json& document, const StructuredShape& structured);

/// Parts, symmetries and relations for people.
std::string structure_text(const StructuredShape& structured, const Model& model);

/// Numbers of parts, symmetries of the whole and relations.
std::string essential_structure(const Structure& structure);

}  // namespace stackabilization::apps
