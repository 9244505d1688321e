#include "apps/common/structure_report.h"

#include <algorithm>
#include <array>

#include "apps/common/text.h"

namespace stackabilization::apps {

namespace {

Json rows_json(const Points& points) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    rows.push_back(to_json(Eigen::Vector3d(points.row(i).transpose())));
  return rows;
}

std::vector<std::string> part_names_of(const Relation& relation, const Structure& structure) {
  std::vector<std::string> names;
  for (const int part : relation.parts)
    names.push_back(structure.parts.at(static_cast<std::size_t>(part)).name);
  return names;
}

std::vector<int> triangle_counts(const Shape& shape) {
  std::vector<int> counts(shape.part_names.size());
  for (const std::int32_t part : shape.triangle_part) ++counts[static_cast<std::size_t>(part)];
  return counts;
}

/// Lengths of the edges of a cuboid along its axes, averaged; length and radii of a cylinder.
std::string size_text(const Primitive& primitive, Unit unit) {
  if (const auto* cuboid = std::get_if<Cuboid>(&primitive)) {
    std::string text;
    for (int axis = 0; axis < 3; ++axis) {
      double length = 0;
      for (int corner = 0; corner < 8; ++corner)
        if ((corner & 1 << axis) == 0)
          length += (cuboid->corners.row(corner | 1 << axis) - cuboid->corners.row(corner)).norm() / 4;
      text += (axis > 0 ? " x " : "") + (axis < 2 ? rounded(length) : quantity(length, unit));
    }
    return text;
  }
  const auto& cylinder = std::get<GeneralizedCylinder>(primitive);
  const double length = section_arc_lengths(cylinder).tail<1>()(0);
  const std::string least = rounded(cylinder.radii.minCoeff()), most = rounded(cylinder.radii.maxCoeff());
  return quantity(length, unit) + (cylinder.closed ? " around" : " long") + ", radius " +
         (least == most ? least : least + " to " + most);
}

std::string symmetry_text(const Symmetry& symmetry, double diagonal) {
  const std::string point = point_text(symmetry.point, diagonal), axis = point_text(symmetry.axis, 1);
  if (symmetry.kind == SymmetryKind::reflection) return "plane through " + point + ", normal " + axis;
  return "axis through " + point + " along " + axis +
         (symmetry.kind == SymmetryKind::revolution ? "" : ", order " + std::to_string(symmetry.order));
}

bool same(const Symmetry& a, const Symmetry& b) {
  return a.kind == b.kind && a.point == b.point && a.axis == b.axis && a.order == b.order;
}

/// The symmetry in words, or its number where it is one of the whole.
std::string symmetry_reference(const Symmetry& symmetry, const Structure& structure) {
  const std::vector<Symmetry>& whole = structure.symmetries;
  const auto found =
      std::find_if(whole.begin(), whole.end(), [&](const Symmetry& s) { return same(s, symmetry); });
  if (found == whole.end()) return symmetry_text(symmetry, structure.diagonal);
  return (symmetry.kind == SymmetryKind::reflection ? "plane " : "axis ") +
         std::to_string(found - whole.begin() + 1) + " of the whole";
}

std::string place_text(const Relation& relation, const Structure& structure) {
  if (!relation.is_joint()) return symmetry_reference(relation.symmetry, structure);
  std::string text;
  for (Eigen::Index i = 0; i < relation.points.rows(); ++i)
    text += (i > 0 ? " to " : "") + point_text(relation.points.row(i).transpose(), structure.diagonal);
  return text;
}

std::string part_table(const StructuredShape& structured) {
  ColumnTable table({"part", "triangles", "primitive", "size", "cuboid fit", "cylinder fit", "note"});
  const std::vector<int> triangles = triangle_counts(structured.shape);
  for (std::size_t i = 0; i < structured.structure.parts.size(); ++i) {
    const Part& part = structured.structure.parts[i];
    const std::optional<double>& cylinder = part.fit.cylinder_error;
    table.add({part.name, std::to_string(triangles[i]), kind_of(part.primitive),
               size_text(part.primitive, structured.shape.unit), small_percent(part.fit.cuboid_error),
               cylinder ? small_percent(*cylinder) : "none", part.fit.note});
  }
  return table.text();
}

std::string relation_table(const Structure& structure) {
  ColumnTable table({"relation", "parts", "where", "residual"});
  for (const Relation& relation : structure.relations)
    table.add({name_of(relation.type), joined(part_names_of(relation, structure)),
               place_text(relation, structure), small_percent(relation.residual)});
  return table.text();
}

std::string tally_text(const Structure& structure) {
  constexpr std::array types = {RelationType::symmetry, RelationType::self_symmetry,
                                RelationType::point_joint, RelationType::line_joint};
  constexpr std::array<const char*, 4> nouns = {"symmetric pair", "self-symmetry", "point joint",
                                                "line joint"};
  std::string text;
  for (std::size_t i = 0; i < types.size(); ++i) {
    const auto count = std::count_if(structure.relations.begin(), structure.relations.end(),
                                     [&](const Relation& relation) { return relation.type == types[i]; });
    if (count == 0) continue;
    const bool plural_of_y = types[i] == RelationType::self_symmetry && count != 1;
    text += (text.empty() ? "" : ", ") +
            (plural_of_y ? std::to_string(count) + " self-symmetries" : counted(count, nouns[i]));
  }
  return text;
}

}  // namespace

std::string kind_of(const Primitive& primitive) {
  return std::holds_alternative<Cuboid>(primitive) ? "cuboid" : "cylinder";
}

Json to_json(const Primitive& primitive) {
  if (const auto* cuboid = std::get_if<Cuboid>(&primitive))
    return {{"kind", kind_of(primitive)}, {"corners", rows_json(cuboid->corners)}};
  const auto& cylinder = std::get<GeneralizedCylinder>(primitive);
  return {{"kind", kind_of(primitive)},
          {"centres", rows_json(cylinder.centres)},
          {"radii", std::vector<double>(cylinder.radii.begin(), cylinder.radii.end())},
          {"closed", cylinder.closed}};
}

Json to_json(const Symmetry& symmetry) {
  if (symmetry.kind == SymmetryKind::reflection)
    return {{"plane", {{"point", to_json(symmetry.point)}, {"normal", to_json(symmetry.axis)}}}};
  return {
      {"axis",
       {{"point", to_json(symmetry.point)},
        {"direction", to_json(symmetry.axis)},
        {"order", symmetry.kind == SymmetryKind::revolution ? Json("revolution") : Json(symmetry.order)}}}};
}

Json to_json(const Relation& relation, const Structure& structure) {
  Json json = {{"type", name_of(relation.type)}, {"parts", part_names_of(relation, structure)}};
  if (relation.is_joint())
    json["points"] = rows_json(relation.points);
  else
    json.update(to_json(relation.symmetry));
  json["residual"] = relation.residual;
  return json;
}

void add_structure(Json& document, const StructuredShape& structured) {
  const Structure& structure = structured.structure;
  const std::vector<int> triangles = triangle_counts(structured.shape);
  Json parts = Json::array(), primitives = Json::array(), symmetries = Json::array(),
       relations = Json::array();
  for (std::size_t i = 0; i < structure.parts.size(); ++i) {
    const Part& part = structure.parts[i];
    parts.push_back({{"name", part.name}, {"triangles", triangles[i]}});
    Json primitive = {{"part", part.name}};
    primitive.update(to_json(part.primitive));
    primitive["fit_errors"] = {{"cuboid", part.fit.cuboid_error},
                               {"cylinder", to_json(part.fit.cylinder_error)}};
    primitive["note"] = part.fit.note;
    primitives.push_back(std::move(primitive));
  }
  for (const Symmetry& symmetry : structure.symmetries) symmetries.push_back(to_json(symmetry));
  for (const Relation& relation : structure.relations) relations.push_back(to_json(relation, structure));
  document["diagonal"] = structure.diagonal;
  document["parts"] = std::move(parts);
  document["primitives"] = std::move(primitives);
  document["symmetries"] = std::move(symmetries);
  document["relations"] = std::move(relations);
}

std::string structure_text(const StructuredShape& structured, const Model& model) {
  const Structure& structure = structured.structure;
  TextTable table;
  add_model_line(table, model);
  const auto cuboids = std::count_if(structure.parts.begin(), structure.parts.end(), [](const Part& part) {
    return std::holds_alternative<Cuboid>(part.primitive);
  });
  const auto cylinders = static_cast<std::ptrdiff_t>(structure.parts.size()) - cuboids;
  table.add("Parts", std::to_string(structure.parts.size()),
            counted(cuboids, "cuboid") + ", " + counted(cylinders, "generalized cylinder") +
                "; fits are errors, of the part's diagonal");
  table.add("Symmetries", std::to_string(structure.symmetries.size()), "of the whole shape");
  for (std::size_t i = 0; i < structure.symmetries.size(); ++i)
    table.add("", std::to_string(i + 1) + " " + name_of(structure.symmetries[i].kind),
              symmetry_text(structure.symmetries[i], structure.diagonal));
  table.add("Relations", std::to_string(structure.relations.size()), tally_text(structure));
  std::string text = table.text() + "\n" + part_table(structured);
  if (!structure.relations.empty())
    text += "\n" + relation_table(structure) +
            "Residuals are how far the surfaces miss a relation, of the diagonal " +
            quantity(structure.diagonal, structured.shape.unit) + ".\n";
  return text;
}

std::string essential_structure(const Structure& structure) {
  return std::to_string(structure.parts.size()) + " " + std::to_string(structure.symmetries.size()) + " " +
         std::to_string(structure.relations.size()) + "\n";
}

}  // namespace stackabilization::apps
