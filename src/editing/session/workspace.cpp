#include "editing/session/workspace.h"

#include <utility>

namespace stackabilization::editing {

Workspace::Workspace(const Project& project, const Requirements& requirements)
    : space_(deformation_model(project.rest, project.space)),
      rest_(std::make_shared<const RestShape>(project.rest, requirements.measure)),
      checker_(std::make_shared<const RequirementChecker>(*space_, requirements, rest_)) {}

Workspace::Workspace(const Workspace& other, const Requirements& requirements)
    : space_(other.space_),
      rest_(other.rest_),
      checker_(std::make_shared<const RequirementChecker>(*space_, requirements, rest_)) {}

DeformationConstraints Workspace::constraints(const Direction& direction) const {
  return deformation_constraints(checker_->requirements(), space_->rest(), direction);
}

MeasuredDesign Workspace::measured(std::shared_ptr<const Design> design, const Direction& direction,
                                   double at_rest, QualityScope scope) const {
  MeasuredDesign result;
  result.assessment = checker_->check(*design, direction, scope);
  result.energy = rest_->energy_meter().energy(*design, result.assessment.measured.value - at_rest);
  result.change = shape_change(space_->rest().shape, design->shape);
  result.design = std::move(design);
  return result;
}

}  // namespace stackabilization::editing
