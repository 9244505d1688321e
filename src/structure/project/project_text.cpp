#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/text.h"
#include "stackabilization/io/write_file.h"
#include "stackabilization/structure/project_file.h"
#include "stackabilization/structure/tolerances.h"

namespace stackabilization {

namespace {

std::string quoted(const std::string& text) {
  try {
    return nlohmann::json(text).dump();
  } catch (const nlohmann::json::exception&) {
    throw InputError("a project file holds UTF-8 text, found " + in_quotes(text));
  }
}

template <class Row>
std::string list(const Row& numbers) {
  std::string text = "[";
  for (Eigen::Index k = 0; k < numbers.size(); ++k) {
    if (k > 0) text += ", ";
    append_number(text, numbers(k) + 0.0);  // no negative zeros
  }
  return text + "]";
}

template <class Rows>
std::string list_of_lists(const Rows& rows) {
  std::string text = "[";
  for (Eigen::Index k = 0; k < rows.rows(); ++k) text += (k > 0 ? ", " : "") + list(rows.row(k));
  return text + "]";
}

std::string number(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

/// Returns the centre and the half axes (rows 0 to 3) of a cuboid, which reproduce its corners up to
/// rounding. They are rounded such that a computation from the reproduced corners gives the same values.
std::optional<Eigen::Matrix<double, 4, 3>> affine_box(const Cuboid& cuboid) {
  Eigen::Matrix<double, 4, 3> box = Eigen::Matrix<double, 4, 3>::Zero();
  for (int k = 0; k < 8; ++k) {
    box.row(0) += cuboid.corners.row(k) / 8;
    for (int a = 0; a < 3; ++a)
      box.row(1 + a) += ((k >> a & 1) != 0 ? 1.0 : -1.0) / 8 * cuboid.corners.row(k);
  }
  const double largest = cuboid.corners.cwiseAbs().maxCoeff();
  if (!(largest > 0)) return std::nullopt;
  const double grid = std::exp2(std::ceil(std::log2(largest))) * tolerance::project_grid;
  if (!(grid > 0)) return std::nullopt;
  box = (box / grid).array().round().matrix() * grid;
  for (int k = 0; k < 8; ++k) {
    Eigen::RowVector3d corner = box.row(0);
    for (int a = 0; a < 3; ++a) corner += ((k >> a & 1) != 0 ? 1.0 : -1.0) * box.row(1 + a);
    if ((corner - cuboid.corners.row(k)).cwiseAbs().maxCoeff() > 4 * grid) return std::nullopt;
  }
  return box;
}

std::string text_of(const Cuboid& cuboid) {
  if (const auto box = affine_box(cuboid))
    return R"({"kind": "cuboid", "centre": )" + list(box->row(0)) + R"(, "half_axes": )" +
           list_of_lists(box->bottomRows(3)) + "}";
  return R"({"kind": "cuboid", "corners": )" + list_of_lists(cuboid.corners) + "}";
}

std::string text_of(const GeneralizedCylinder& cylinder) {
  std::string text = R"({"kind": "cylinder", "closed": )";
  text += cylinder.closed ? "true" : "false";
  const Eigen::Quaterniond& turn = cylinder.rotation;
  if (turn.coeffs() != Eigen::Quaterniond::Identity().coeffs())
    text += R"(, "rotation": )" + list(Eigen::Vector4d(turn.w(), turn.x(), turn.y(), turn.z()));
  text += ", \"sections\": [";
  for (Eigen::Index k = 0; k < cylinder.centres.rows(); ++k) {
    Eigen::RowVector4d section;
    section << cylinder.centres.row(k), cylinder.radii(k);
    text += (k > 0 ? ",\n      " : "\n      ") + list(section);
  }
  return text + "]}";
}

std::string text_of(const Part& part) {
  std::string text = "    {\"name\": " + quoted(part.name) + ",\n     \"primitive\": ";
  text += std::visit([](const auto& primitive) { return text_of(primitive); }, part.primitive);
  text += ",\n     \"fit\": {\"cuboid_error\": " + number(part.fit.cuboid_error);
  if (part.fit.cylinder_error) text += ", \"cylinder_error\": " + number(*part.fit.cylinder_error);
  return text + ", \"note\": " + quoted(part.fit.note) + "}}";
}

std::string text_of(const Symmetry& symmetry) {
  std::string text = "{\"kind\": " + quoted(name_of(symmetry.kind));
  text += ", \"point\": " + list(symmetry.point) + ", \"axis\": " + list(symmetry.axis);
  if (symmetry.kind == SymmetryKind::rotation) text += ", \"order\": " + std::to_string(symmetry.order);
  return text + "}";
}

std::string text_of(const Relation& relation, const std::vector<Part>& parts) {
  std::string text = "    {\"type\": " + quoted(name_of(relation.type)) + ", \"parts\": [";
  for (std::size_t k = 0; k < relation.parts.size(); ++k)
    text += (k > 0 ? ", " : "") + quoted(parts[static_cast<std::size_t>(relation.parts[k])].name);
  text += relation.is_joint() ? "], \"points\": " + list_of_lists(relation.points)
                              : "], \"symmetry\": " + text_of(relation.symmetry);
  return text + ", \"residual\": " + number(relation.residual) + "}";
}

template <class Range, class Write>
std::string lines(const Range& range, const Write& write) {
  std::string text;
  for (const auto& one : range) text += (text.empty() ? "\n" : ",\n") + write(one);
  return text;
}

std::string mesh_text(const Shape& shape) {
  std::string text = "{\"vertices\": [";
  for (Eigen::Index v = 0; v < shape.vertex_count(); ++v) {
    text += v > 0 ? ",\n    " : "\n    ";
    text += list(shape.vertices.row(v));
  }
  text += "],\n    \"triangles\": [";
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    text += t > 0 ? ",\n    [" : "\n    [";
    for (int k = 0; k < 3; ++k) text += std::to_string(shape.triangles(t, k)) + ", ";
    text += std::to_string(shape.triangle_part[static_cast<std::size_t>(t)]) + "]";
  }
  return text + "]}";
}

}  // namespace

std::string project_text(const StructuredShape& structured) {
  return project_text(structured, ProjectSections{});
}

std::string project_text(const StructuredShape& structured, const ProjectSections& sections) {
  validate(structured);
  const auto& [shape, structure] = structured;
  std::string text = "{\"format\": \"stackabilize project\",\n \"version\": 1,\n \"unit\": \"";
  text += shape.unit == Unit::unknown ? "unknown" : unit_symbol(shape.unit);
  text += "\",\n \"parts\": [" + lines(structure.parts, [](const Part& part) { return text_of(part); });
  text += "],\n \"symmetries\": [";
  text += lines(structure.symmetries, [](const Symmetry& symmetry) { return "    " + text_of(symmetry); });
  text += "],\n \"relations\": [";
  text += lines(structure.relations,
                [&](const Relation& relation) { return text_of(relation, structured.structure.parts); });
  text += "],\n \"mesh\": " + mesh_text(shape);
  if (sections.history) text += ",\n \"history\": " + *sections.history;
  return text + "}\n";
}

void write_project(const StructuredShape& structured, const std::filesystem::path& path) {
  write_file_atomically(path, project_text(structured));
}

}  // namespace stackabilization
