#include "stackabilization/structure/structure.h"

#include "core/index.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

void validate_relation(const Relation& relation, std::size_t part_count, const std::string& place) {
  const std::size_t wanted = relation.type == RelationType::self_symmetry ? 1 : 2;
  if (relation.parts.size() != wanted)
    throw InputError(place + " needs " + std::to_string(wanted) + " part(s), found " +
                     std::to_string(relation.parts.size()));
  for (const int part : relation.parts)
    if (part < 0 || static_cast<std::size_t>(part) >= part_count)
      throw InputError(place + " names a part that does not exist");
  if (wanted == 2 && relation.parts[0] == relation.parts[1])
    throw InputError(place + " relates a part to itself");
  if (relation.is_joint()) {
    const Eigen::Index points = relation.type == RelationType::point_joint ? 1 : 2;
    if (relation.points.rows() != points || !relation.points.allFinite())
      throw InputError(place + " needs " + std::to_string(points) + " finite point(s)");
    return;
  }
  const Symmetry& symmetry = relation.symmetry;
  if (!symmetry.point.allFinite() || !symmetry.axis.allFinite() || !(symmetry.axis.norm() > 0))
    throw InputError(place + " needs a finite point and an axis that is not zero");
  if (symmetry.kind == SymmetryKind::rotation && symmetry.order < 2)
    throw InputError(place + " needs an order of at least 2, found " + std::to_string(symmetry.order));
}

}  // namespace

std::string name_of(RelationType type) {
  switch (type) {
    case RelationType::symmetry:
      return "symmetry";
    case RelationType::self_symmetry:
      return "self_symmetry";
    case RelationType::point_joint:
      return "point_joint";
    case RelationType::line_joint:
      return "line_joint";
  }
  return {};
}

std::string describe(const Relation& relation, const Structure& structure) {
  std::string text;
  switch (relation.type) {
    case RelationType::symmetry:
      text = "symmetry";
      break;
    case RelationType::self_symmetry:
      text = "self-symmetry";
      break;
    case RelationType::point_joint:
      text = "point joint";
      break;
    case RelationType::line_joint:
      text = "line joint";
      break;
  }
  for (std::size_t k = 0; k < relation.parts.size(); ++k)
    text += (k > 0 ? " and '" : " of '") + structure.parts.at(detail::at(relation.parts[k])).name + "'";
  return text;
}

void validate(const StructuredShape& structured) {
  validate(structured.shape);
  const Structure& structure = structured.structure;
  if (structure.parts.size() != structured.shape.part_names.size())
    throw InputError("the structure has " + std::to_string(structure.parts.size()) + " part(s), the shape " +
                     std::to_string(structured.shape.part_names.size()));
  for (std::size_t k = 0; k < structure.parts.size(); ++k) {
    const Part& part = structure.parts[k];
    if (part.name != structured.shape.part_names[k])
      throw InputError("part " + std::to_string(k) + " of the structure is called '" + part.name +
                       "', that of the shape '" + structured.shape.part_names[k] + "'");
    validate(part.primitive, part.name);
  }
  for (std::size_t k = 0; k < structure.relations.size(); ++k)
    validate_relation(structure.relations[k], structure.parts.size(),
                      "relation " + std::to_string(k) + " (" + name_of(structure.relations[k].type) + ")");
}

}  // namespace stackabilization
