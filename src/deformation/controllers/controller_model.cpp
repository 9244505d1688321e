#include "stackabilization/deformation/controller_model.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "deformation/controllers/edit_solution.h"
#include "deformation/controllers/part_edit.h"
#include "deformation/model/joint_slides.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {

struct ControllerModel::Data {
  Data(StructuredShape structured, const ControllerLimits& limits, Following following)
      : rest(sliding(std::move(structured), following)),
        rig(within(limits, rest.structure, following)),
        mesh{detail::MeshTransfer(rest.shape, rig), detail::vertices_by_class(rest.shape, rig),
             SurfaceIndex(rest.shape)} {
    for (const Part& part : rest.structure.parts) primitives.push_back(part.primitive);
  }

  static StructuredShape sliding(StructuredShape structured, Following following) {
    if (following == Following::smooth) detail::let_joints_slide(structured.structure);
    return structured;
  }

  static detail::Rig within(const ControllerLimits& limits, const Structure& structure, Following following) {
    detail::Rig rig(structure, following);
    if (rig.distinct_joints.size() > limits.max_joint_points)
      throw InputError("its parts are joined at " + std::to_string(rig.distinct_joints.size()) +
                       " points that no symmetry makes the same, and edits keep at most " +
                       std::to_string(limits.max_joint_points) + " of them");
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
    if (!same) throw UsageError("the configuration does not have the primitives of the shape");
  }

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

const StructuredShape& ControllerModel::rest() const {
  return data_->rest;
}

const std::vector<Primitive>& ControllerModel::rest_primitives() const {
  return data_->primitives;
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

EditOutcome ControllerModel::edited(const std::vector<Primitive>& now, const Edit& edit,
                                    const DeformationConstraints& constraints) const {
  validate(edit, data_->rest.structure.diagonal);
  validate(constraints, data_->rest.shape);
  data_->check(now);
  detail::EditTask task{data_->rest.shape, now, {}, constraints};
  if (edit.handle.kind == HandleKind::shape) {
    task.wanted = detail::edit_handle(now, edit.operation);
  } else {
    const Part& part = data_->part(edit.handle);
    task.wanted = {detail::edit_handle(now[static_cast<std::size_t>(edit.handle.part)], edit, part.name)};
  }
  return detail::solve_edit(data_->rig, data_->mesh, task);
}

Shape ControllerModel::shape_of(const std::vector<Primitive>& now) const {
  data_->check(now);
  Shape shape = data_->rest.shape;
  shape.vertices = data_->mesh.transfer.vertices(data_->rig, now);
  return shape;
}

DeformationResult ControllerModel::deformed(const std::vector<Edit>& edits,
                                            const DeformationConstraints& constraints) const {
  DeformationResult result{std::nullopt, {}, data_->primitives};
  for (const Edit& edit : edits) {
    EditOutcome outcome = edited(result.primitives, edit, constraints);
    result.primitives = std::move(outcome.primitives);
    if (outcome.refusal) {
      result = {std::move(outcome.refusal), {}, data_->primitives};
      break;
    }
  }
  result.shape = shape_of(result.primitives);
  return result;
}

}  // namespace stackabilization
