#include "stackabilization/structure/ctrl_grp_files.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/bounding_diagonal.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/io/read_file.h"
#include "stackabilization/structure/analysis.h"
#include "stackabilization/structure/tolerances.h"
#include "structure/model/fit_error.h"
#include "structure/model/nearest_box.h"
#include "structure/project/ctrl_grp_text.h"

namespace stackabilization {

namespace {

using detail::CtrlGrpRelation;

detail::CtrlGrpFrame frame_of(const Shape& shape) {
  detail::CtrlGrpFrame frame{Eigen::Vector3d::Zero(), bounding_diagonal(shape) / 2};
  for (int a = 0; a < 3; ++a) {
    const Range range = range_along(shape, Eigen::Vector3d::Unit(a));
    frame.centre(a) = range.low + range.length() / 2;
  }
  return frame;
}

class StructureBuilder {
 public:
  explicit StructureBuilder(const Shape& shape) : shape_(shape) {
    structure_.diagonal = bounding_diagonal(shape);
    for (const FoundSymmetry& found : find_symmetries(shape)) structure_.symmetries.push_back(found.symmetry);
  }

  void add_parts(const std::map<int, Primitive>& primitives) {
    for (int row = 0; row < static_cast<int>(shape_.part_names.size()); ++row) {
      const Shape part = extract_part(shape_, row);
      const auto given = primitives.find(row);
      const std::string& name = shape_.part_names[static_cast<std::size_t>(row)];
      if (given == primitives.end()) {
        FittedPrimitive fitted = fit_primitive(part);
        structure_.parts.push_back({name, std::move(fitted.primitive), std::move(fitted.fit)});
      } else {
        structure_.parts.push_back({name, given->second, fit_of(given->second, part)});
      }
    }
  }

  void add(const CtrlGrpRelation& relation) {
    switch (relation.type) {
      case RelationType::symmetry:
        return add_pair(relation);
      case RelationType::self_symmetry:
        return add_selves(relation);
      default:
        break;
    }
    structure_.relations.push_back(
        {.type = relation.type, .parts = relation.parts, .symmetry = {}, .points = relation.vectors});
  }

  Structure finished(const std::string& name) {
    std::stable_sort(structure_.relations.begin(), structure_.relations.end(),
                     [](const Relation& a, const Relation& b) { return a.is_joint() < b.is_joint(); });
    try {
      symmetrize(structure_);
    } catch (const InputError& error) {
      throw InputError(name + ": " + error.what());
    }
    return std::move(structure_);
  }

 private:
  /// Measures the error of the given kind; the error of the other kind is unknown.
  static PrimitiveFit fit_of(const Primitive& primitive, const Shape& part) {
    const detail::FitSurface surface(part);
    const double diagonal = bounding_diagonal(part);
    PrimitiveFit fit;
    fit.note = "read from a file";
    if (const auto* cuboid = std::get_if<Cuboid>(&primitive)) {
      fit.cuboid_error = detail::fit_error(nearest_box(*cuboid), surface) / diagonal;
    } else {
      fit.cuboid_error = detail::fit_error(minimal_oriented_box(HullSupport(part)), surface) / diagonal;
      fit.cylinder_error = detail::fit_error(std::get<GeneralizedCylinder>(primitive), surface) / diagonal;
    }
    return fit;
  }

  const Primitive& primitive(int row) const {
    return structure_.parts[static_cast<std::size_t>(row)].primitive;
  }

  Eigen::Vector3d centre(int row) const {
    return control_points(primitive(row)).colwise().mean().transpose();
  }

  void add_pair(const CtrlGrpRelation& relation) {
    const Eigen::Vector3d a = centre(relation.parts[0]), b = centre(relation.parts[1]);
    if (!((a - b).norm() > tolerance::relative * structure_.diagonal))
      throw InputError(relation.place + ": no plane lies midway between two primitives with one centre");
    push(RelationType::symmetry, relation.parts, bisector(a, b));
  }

  void push(RelationType type, const std::vector<int>& parts, const Symmetry& symmetry) {
    Relation relation{.type = type, .parts = parts, .symmetry = symmetry, .points = {}};
    relation.residual = residual(relation);
    structure_.relations.push_back(relation);
  }

  /// Root mean square distance from the first part's image to the second part.
  double residual(const Relation& relation) const {
    const SurfaceSamples samples = surface_samples(extract_part(shape_, relation.parts.front()), 1000);
    const SurfaceIndex target(extract_part(shape_, relation.parts.back()));
    const Eigen::Isometry3d map = isometry_of(relation.symmetry);
    double sum = 0;
    for (const auto& row : samples.points.rowwise())
      sum += std::pow(target.nearest(map * row.transpose()).distance, 2);
    return std::sqrt(sum / static_cast<double>(samples.points.rows())) / structure_.diagonal;
  }

  void add_selves(const CtrlGrpRelation& relation) {
    if (std::holds_alternative<GeneralizedCylinder>(primitive(relation.parts[0])))
      return add_cylinder_selves(relation);
    const Eigen::Vector3d middle = centre(relation.parts[0]);
    std::vector<Relation> planes;
    const auto candidate = [&](const Eigen::Vector3d& normal) {
      planes.push_back({.type = RelationType::self_symmetry,
                        .parts = relation.parts,
                        .symmetry = {.point = middle, .axis = normal},
                        .points = {}});
      planes.back().residual = residual(planes.back());
    };
    if (relation.vectors.rows() > 0) {
      for (const auto& normal : relation.vectors.rowwise()) candidate(normal.transpose());
    } else {
      const Eigen::Matrix3d axes = nearest_box(std::get<Cuboid>(primitive(relation.parts[0]))).axes;
      for (int a = 0; a < 3; ++a) candidate(axes.col(a));
      std::stable_sort(planes.begin(), planes.end(),
                       [](const Relation& a, const Relation& b) { return a.residual < b.residual; });
      planes.resize(static_cast<std::size_t>(relation.count));
    }
    structure_.relations.insert(structure_.relations.end(), planes.begin(), planes.end());
  }

  void add_cylinder_selves(const CtrlGrpRelation& relation) {
    const Eigen::Vector3d middle = centre(relation.parts[0]);
    const Points offsets = control_points(primitive(relation.parts[0])).rowwise() - middle.transpose();
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(offsets, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Eigen::Vector3d along = svd.matrixV().col(0);
    Eigen::Vector3d normal =
        svd.matrixV().cols() > 2 ? Eigen::Vector3d(svd.matrixV().col(2)) : along.unitOrthogonal();
    if (relation.count == 1)
      return push(RelationType::self_symmetry, relation.parts, {.point = middle, .axis = normal});
    // Every plane through the axis of a body of revolution is a symmetry plane. A symmetry plane of the shape
    // is preferred.
    for (const Symmetry& symmetry : structure_.symmetries)
      if (symmetry.kind == SymmetryKind::reflection &&
          std::abs(symmetry.axis.dot(along)) <= tolerance::same_symmetry &&
          std::abs(symmetry.axis.dot(middle - symmetry.point)) <=
              tolerance::same_symmetry * structure_.diagonal) {
        normal = (symmetry.axis - symmetry.axis.dot(along) * along).normalized();
        break;
      }
    push(RelationType::self_symmetry, relation.parts, {.point = middle, .axis = normal});
    push(RelationType::self_symmetry, relation.parts,
         {.point = middle, .axis = along.cross(normal).normalized()});
    push(RelationType::self_symmetry, relation.parts,
         {.kind = SymmetryKind::revolution, .point = middle, .axis = along});
  }

  const Shape& shape_;
  Structure structure_;
};

}  // namespace

Structure parse_ctrl_grp(const Shape& shape, const NamedText& controls, const NamedText& groups) {
  validate(shape);
  const detail::CtrlGrpFrame frame = frame_of(shape);
  StructureBuilder builder(shape);
  builder.add_parts(detail::parse_ctrl(controls, shape.part_names, frame));
  for (const CtrlGrpRelation& relation : detail::parse_grp(groups, shape.part_names, frame))
    builder.add(relation);
  return builder.finished(groups.name);
}

Structure read_ctrl_grp(const Shape& shape, const CtrlGrpFiles& files) {
  const auto text_of = [](const std::optional<std::filesystem::path>& path) {
    return path ? read_file(*path) : std::string();
  };
  const auto name_of_file = [](const std::optional<std::filesystem::path>& path) {
    return path ? path->string() : std::string("no file");
  };
  const std::string controls = text_of(files.controls), groups = text_of(files.groups);
  return parse_ctrl_grp(shape, {controls, name_of_file(files.controls)},
                        {groups, name_of_file(files.groups)});
}

}  // namespace stackabilization
