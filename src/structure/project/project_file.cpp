#include "stackabilization/structure/project_file.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "core/bounding_diagonal.h"
#include "io/formats/json_node.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/io/read_file.h"
#include "stackabilization/structure/analysis.h"
#include "stackabilization/structure/tolerances.h"
#include "structure/analysis/symmetrize.h"

namespace stackabilization {

namespace {

using detail::JsonNode;

class ProjectReader {
 public:
  explicit ProjectReader(const JsonNode& root) : root_(root) {}

  StructuredShape read() {
    root_.expect_keys({"format", "version", "unit", "parts", "symmetries", "relations", "mesh", "history"},
                      1);
    root_["format"].one_of({"stackabilize project"});
    root_["version"].integer(1, 1);
    const std::vector<Unit> units = {Unit::unknown, Unit::micrometre, Unit::millimetre, Unit::centimetre,
                                     Unit::metre,   Unit::inch,       Unit::foot};
    std::vector<std::string> symbols = {"unknown"};
    for (std::size_t k = 1; k < units.size(); ++k) symbols.push_back(unit_symbol(units[k]));
    result_.shape.unit = units[root_["unit"].one_of(symbols)];
    read_parts(root_["parts"]);
    read_mesh(root_["mesh"]);
    for (std::size_t k = 0; k < root_["symmetries"].list_size(); ++k)
      result_.structure.symmetries.push_back(symmetry(root_["symmetries"][k]));
    for (std::size_t k = 0; k < root_["relations"].list_size(); ++k)
      result_.structure.relations.push_back(relation(root_["relations"][k]));
    return std::move(result_);
  }

 private:
  static Eigen::Vector3d vector(const JsonNode& node) { return node.numbers(3); }

  /// Vectors typed with a few digits are normalised; vectors that a program wrote stay unchanged.
  static Eigen::VectorXd unit(const JsonNode& node, std::size_t size, const std::string& what) {
    constexpr double written_digits = 0.001;
    Eigen::VectorXd result = node.numbers(size);
    const double length = result.norm();
    if (!(std::abs(length - 1) <= written_digits)) node.fail("expected " + what + " of length 1");
    if (std::abs(length - 1) > tolerance::rounding) result /= length;
    return result;
  }

  void read_parts(const JsonNode& parts) {
    if (parts.list_size() == 0) parts.fail_expected("at least one part");
    for (std::size_t k = 0; k < parts.list_size(); ++k) {
      const JsonNode node = parts[k];
      node.expect_keys({"name", "primitive", "fit"}, 1);
      Part part{node["name"].text(), primitive(node["primitive"]), {}};
      if (part.name.empty()) node["name"].fail_expected("a name");
      if (std::count(names_.begin(), names_.end(), part.name) > 0)
        node["name"].fail("expected part names that differ from each other, found '" + part.name + "' again");
      try {
        validate(part.primitive, part.name);
      } catch (const InputError& error) {
        node["primitive"].fail(error.what());
      }
      if (node.has("fit")) part.fit = fit(node["fit"]);
      names_.push_back(part.name);
      result_.structure.parts.push_back(std::move(part));
    }
    result_.shape.part_names = names_;
  }

  static PrimitiveFit fit(const JsonNode& node) {
    node.expect_keys({"cuboid_error", "cylinder_error", "note"}, 2);
    PrimitiveFit result;
    result.cuboid_error = error(node["cuboid_error"]);
    if (node.has("cylinder_error")) result.cylinder_error = error(node["cylinder_error"]);
    if (node.has("note")) result.note = node["note"].text();
    return result;
  }

  static double error(const JsonNode& node) {
    if (node.number() < 0) node.fail_expected("a number that is not negative");
    return node.number();
  }

  static Primitive primitive(const JsonNode& node) {
    node.expect_keys({"kind", "centre", "half_axes", "corners", "closed", "rotation", "sections"}, 6);
    if (node["kind"].one_of({"cuboid", "cylinder"}) == 1) return cylinder(node);
    Cuboid cuboid;
    if (node.has("corners")) {
      node.expect_keys({"kind", "corners"});
      node["corners"].expect_size(8);
      cuboid.corners = node["corners"].table(3, 8);
      return cuboid;
    }
    node.expect_keys({"kind", "centre", "half_axes"});
    const Eigen::Vector3d centre = vector(node["centre"]);
    node["half_axes"].expect_size(3);
    const Eigen::Matrix3d half_axes = node["half_axes"].table(3, 3);
    for (int k = 0; k < 8; ++k) {
      cuboid.corners.row(k) = centre.transpose();
      for (int a = 0; a < 3; ++a)
        cuboid.corners.row(k) += ((k >> a & 1) != 0 ? 1.0 : -1.0) * half_axes.row(a);
    }
    return cuboid;
  }

  static Primitive cylinder(const JsonNode& node) {
    node.expect_keys({"kind", "closed", "sections", "rotation"}, 1);
    GeneralizedCylinder result;
    result.closed = node["closed"].boolean();
    const auto sections = node["sections"].table(4, result.closed ? 3 : 2);
    result.centres = sections.leftCols(3);
    result.radii = sections.col(3);
    if (node.has("rotation")) {
      const Eigen::VectorXd turn = unit(node["rotation"], 4, "a rotation");
      result.rotation = Eigen::Quaterniond(turn(0), turn(1), turn(2), turn(3));
    }
    return result;
  }

  void read_mesh(const JsonNode& node) {
    node.expect_keys({"vertices", "triangles"});
    Shape& shape = result_.shape;
    shape.vertices = node["vertices"].table(3, 3);
    const JsonNode triangles = node["triangles"];
    if (triangles.list_size() == 0) triangles.fail_expected("at least one triangle");
    shape.triangles.resize(static_cast<Eigen::Index>(triangles.list_size()), 3);
    for (std::size_t t = 0; t < triangles.list_size(); ++t) {
      const JsonNode row = triangles[t];
      row.expect_size(4);
      for (std::size_t k = 0; k < 3; ++k)
        shape.triangles(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(k)) =
            static_cast<std::int32_t>(row[k].integer(0, shape.vertex_count() - 1));
      shape.triangle_part.push_back(static_cast<std::int32_t>(row[3].integer(0, shape.part_count() - 1)));
    }
    for (std::size_t k = 0; k < names_.size(); ++k)
      if (std::count(shape.triangle_part.begin(), shape.triangle_part.end(), static_cast<std::int32_t>(k)) ==
          0)
        triangles.fail("part '" + names_[k] + "' has no triangle");
    validate(shape);
    result_.structure.diagonal = bounding_diagonal(shape);
    if (!(result_.structure.diagonal > 0)) node.fail_expected("a mesh of positive size");
  }

  static Symmetry symmetry(const JsonNode& node) {
    node.expect_keys({"kind", "point", "axis", "order"}, 1);
    Symmetry result;
    result.kind =
        std::vector{SymmetryKind::reflection, SymmetryKind::rotation,
                    SymmetryKind::revolution}[node["kind"].one_of({"reflection", "rotation", "revolution"})];
    result.point = vector(node["point"]);
    result.axis = unit(node["axis"], 3, "an axis");
    if (result.kind == SymmetryKind::rotation) {
      if (!node.has("order")) node.fail("the key 'order' is missing");
      result.order = static_cast<int>(node["order"].integer(2, std::numeric_limits<int>::max()));
    }
    return result;
  }

  Relation relation(const JsonNode& node) const {
    node.expect_keys({"type", "parts", "symmetry", "points", "residual"}, 3);
    const std::vector<RelationType> types = {RelationType::symmetry, RelationType::self_symmetry,
                                             RelationType::point_joint, RelationType::line_joint};
    std::vector<std::string> type_names;
    for (const RelationType type : types) type_names.push_back(name_of(type));
    Relation result;
    result.type = types[node["type"].one_of(type_names)];
    const std::size_t part_count = result.type == RelationType::self_symmetry ? 1 : 2;
    node["parts"].expect_size(part_count);
    for (std::size_t k = 0; k < part_count; ++k)
      result.parts.push_back(static_cast<int>(node["parts"][k].one_of(names_)));
    if (result.parts.front() == result.parts.back() && part_count == 2)
      node["parts"].fail("expected two different parts");
    if (result.type == RelationType::symmetry || result.type == RelationType::self_symmetry) {
      node.expect_keys({"type", "parts", "symmetry", "residual"}, 1);
      result.symmetry = symmetry(node["symmetry"]);
    } else {
      node.expect_keys({"type", "parts", "points", "residual"}, 1);
      const std::size_t points = result.type == RelationType::point_joint ? 1 : 2;
      node["points"].expect_size(points);
      result.points = node["points"].table(3, points);
    }
    if (node.has("residual")) result.residual = error(node["residual"]);
    return result;
  }

  JsonNode root_;
  std::vector<std::string> names_;  ///< of the parts
  StructuredShape result_;
};

bool is_symmetric_enough(const Structure& structure) {
  double largest = structure.diagonal;
  for (const Part& part : structure.parts)
    largest = std::max(largest, control_points(part.primitive).cwiseAbs().maxCoeff());
  return std::all_of(structure.relations.begin(), structure.relations.end(), [&](const Relation& relation) {
    return relation.is_joint() ||
           detail::symmetry_residual(structure, relation) <= tolerance::symmetrized * largest;
  });
}

}  // namespace

ProjectContents project_contents(std::string_view text, const std::string& name) {
  const nlohmann::ordered_json document = detail::parse_json(text, name);
  ProjectContents result{ProjectReader(JsonNode(document, name)).read(), {}};
  try {
    validate(result.structured);
    if (!is_symmetric_enough(result.structured.structure)) symmetrize(result.structured.structure);
  } catch (const InputError& error) {
    throw InputError(name + ": " + error.what());
  }
  if (const auto history = document.find("history"); history != document.end())
    result.sections.history = history->dump();
  return result;
}

StructuredShape project_of_text(std::string_view text, const std::string& name) {
  return project_contents(text, name).structured;
}

StructuredShape read_project(const std::filesystem::path& path) {
  return project_of_text(read_file(path), path == "-" ? "standard input" : path.string());
}

}  // namespace stackabilization
