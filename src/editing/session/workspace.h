#pragma once

#include <memory>

#include "stackabilization/editing/session.h"

namespace stackabilization::editing {

/// A design space with the checks of its designs. Immutable, shared by the session and its jobs.
class Workspace {
 public:
  /// Throws as `deformation_model` and the constructor of RequirementChecker.
  Workspace(const Project& project, const Requirements& requirements);
  /// Makes the workspace of the same shape with other requirements of the same measure.
  Workspace(const Workspace& other, const Requirements& requirements);

  const DeformationModel& space() const { return *space_; }
  const RequirementChecker& checker() const { return *checker_; }
  DeformationConstraints constraints(const Direction& direction) const;
  /// Measures a design along r. `at_rest`: S of the shape at rest along r. `scope`: measures of quality among
  /// the checks.
  MeasuredDesign measured(std::shared_ptr<const Design> design, const Direction& direction, double at_rest,
                          QualityScope scope = QualityScope::parts) const;

 private:
  std::shared_ptr<const DeformationModel> space_;
  std::shared_ptr<const RestShape> rest_;
  std::shared_ptr<const RequirementChecker> checker_;
};

}  // namespace stackabilization::editing
