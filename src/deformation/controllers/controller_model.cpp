#include "stackabilization/deformation/controller_model.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "deformation/controllers/edit_solution.h"
#include "deformation/controllers/part_edit.h"
#include "deformation/controllers/taper.h"
#include "deformation/model/hollow.h"
#include "deformation/model/joint_slides.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {

struct ControllerModel::Data {
  Data(StructuredShape structured, const ControllerLimits& limits, Following how)
      : following(how),
        rest(prepared(std::move(structured), following)),
        rig(within(limits, rest.structure, following)),
        mesh{detail::MeshTransfer(rest.shape, rig, following), detail::vertices_by_class(rest.shape, rig),
             SurfaceIndex(rest.shape)} {
    for (const Part& part : rest.structure.parts) primitives.push_back(part.primitive);
  }

  static StructuredShape prepared(StructuredShape structured, Following following) {
    if (following != Following::smooth) return structured;
    detail::keep_walls(structured);
    detail::let_joints_yield(structured.structure);
    return structured;
  }

  static detail::Rig within(const ControllerLimits& limits, const Structure& structure, Following following) {
    detail::Rig rig(structure, following);
    if (rig.distinct_joints.size() > limits.max_joint_points)
      throw InputError("its parts are joined at " + std::to_string(rig.distinct_joints.size()) +
                       " points that no symmetry makes the same, and edits keep at most " +
                       std::to_string(limits.max_joint_points) + " of them");
    if (rig.distinct_joints.size() + rig.row_points.size() > limits.max_joint_points) rig.row_points.clear();
    return rig;
  }

  const Part& part(const Handle& handle) const {
    if (handle.part < 0 || static_cast<std::size_t>(handle.part) >= rest.structure.parts.size())
      throw UsageError("there is no part " + std::to_string(handle.part) + ": the shape has " +
                       std::to_string(rest.structure.parts.size()));
    return rest.structure.parts[static_cast<std::size_t>(handle.part)];
  }

  void check(const std::vector<Primitive>& now) const {
    bool same = now.size() == primitives.size();
    for (std::size_t k = 0; same && k < now.size(); ++k)
      same = now[k].index() == primitives[k].index() &&
             control_points(now[k]).rows() == control_points(primitives[k]).rows();
    if (!same) throw UsageError("the design does not have the primitives of the shape");
  }

  detail::EditOutcome edited(const std::vector<Primitive>& now, const Edit& edit,
                             const DeformationConstraints& constraints) const {
    validate(edit, rest.structure.diagonal);
    validate(constraints, rest.shape);
    check(now);
    detail::EditTask task{rest.shape, now, {}, constraints};
    if (const auto* taper = std::get_if<Taper>(&edit.operation)) {
      task.wanted = detail::tapered(now, *taper, rest.structure);
      task.is_taper = true;
    } else if (edit.handle.kind == HandleKind::shape) {
      task.wanted = detail::edit_handle(now, edit.operation, following);
    } else {
      const Part& edited = part(edit.handle);
      task.wanted = {
          detail::edit_handle(now[static_cast<std::size_t>(edit.handle.part)], edit, edited.name, following)};
      task.gives_way = following == Following::smooth && edit.handle.kind == HandleKind::part &&
                       std::holds_alternative<Move>(edit.operation);
    }
    return detail::solve_edit(rig, mesh, task);
  }

  Following following;
  StructuredShape rest;
  std::vector<Primitive> primitives;
  detail::Rig rig;
  detail::RiggedMesh mesh;
};

namespace {

StructuredShape validated(StructuredShape structured) {
  validate(structured);
  if (!(structured.structure.diagonal > 0) || !std::isfinite(structured.structure.diagonal))
    throw InputError("the diagonal of the structure must be positive");
  return structured;
}

}  // namespace

ControllerModel::ControllerModel(StructuredShape rest, const ControllerLimits& limits, Following following)
    : data_(std::make_unique<const Data>(validated(std::move(rest)), limits, following)) {}
ControllerModel::ControllerModel(ControllerModel&&) noexcept = default;
ControllerModel& ControllerModel::operator=(ControllerModel&&) noexcept = default;
ControllerModel::~ControllerModel() = default;

Following ControllerModel::following() const {
  return data_->following;
}

const StructuredShape& ControllerModel::rest() const {
  return data_->rest;
}

std::vector<Handle> ControllerModel::handles() const {
  std::vector<Handle> handles = {{HandleKind::shape, 0, 0}};
  for (std::size_t part = 0; part < data_->primitives.size(); ++part)
    for (const Handle& handle : detail::handles_of(static_cast<int>(part), data_->primitives[part]))
      handles.push_back(handle);
  return handles;
}

Eigen::Vector3d ControllerModel::centre(const Handle& handle) const {
  if (handle.kind == HandleKind::shape) return detail::shape_centre(data_->primitives);
  const Part& part = data_->part(handle);
  return detail::handle_centre(part.primitive, handle, part.name);
}

DeformationResult ControllerModel::edited(const Design& now, const Edit& edit,
                                          const DeformationConstraints& constraints) const {
  detail::EditOutcome outcome = data_->edited(now.primitives, edit, constraints);
  if (outcome.refusal) return {std::move(outcome.refusal), now};
  Design design{now.edits, std::move(outcome.primitives), {}};
  design.edits.push_back(edit);
  design.shape = shape_of(design.primitives);
  return {std::nullopt, std::move(design)};
}

DeformationResult ControllerModel::deformed(const std::vector<Edit>& edits,
                                            const DeformationConstraints& constraints) const {
  DeformationResult result{std::nullopt, {{}, data_->primitives, {}}};
  Design& design = result.design;
  for (const Edit& edit : edits) {
    detail::EditOutcome outcome = data_->edited(design.primitives, edit, constraints);
    if (outcome.refusal) {
      result.refusal = std::move(outcome.refusal);
      break;
    }
    design.primitives = std::move(outcome.primitives);
    design.edits.push_back(edit);
  }
  design.shape = design.edits.empty() ? data_->rest.shape : shape_of(design.primitives);
  return result;
}

Shape ControllerModel::shape_of(const std::vector<Primitive>& primitives) const {
  data_->check(primitives);
  Shape shape = data_->rest.shape;
  shape.vertices = data_->mesh.transfer.vertices(data_->rig, primitives);
  return shape;
}

}  // namespace stackabilization
