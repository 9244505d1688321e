#pragma once

#include <optional>
#include <vector>

#include "improvement/quality/thickness.h"
#include "stackabilization/improvement/requirements.h"

namespace stackabilization::detail {

/// A design stacked along r, with the measures already made.
struct CheckedDesign {
  const Design& design;
  const SeparationTree& tree;
  const Direction& direction;
  const Assessment& assessment;  ///< its checks are still empty
};

/// Checks of a RequirementChecker, with everything that depends on the shape at rest alone.
class RequirementChecks {
 public:
  /// `stay`: parts that may not change, ascending. Preconditions: the requirements are valid; both references
  /// outlive this object.
  RequirementChecks(const DeformationModel& space, const Requirements& requirements, std::vector<int> stay);

  /// Makes all required checks, in the order of CheckKind.
  std::vector<Check> of(const CheckedDesign& checked, QualityScope scope) const;
  /// Checks the quality alone; nothing if it is not looked at.
  std::vector<Check> quality(const Design& design, QualityScope scope) const;

 private:
  struct StayingPart {
    int part = 0;
    std::vector<Eigen::Index> vertices;  ///< vertices that have to stay
    /// Whether the primitive has to stay instead of the vertices: on a part that shares vertices with one
    /// that may change.
    bool by_primitive = false;
  };

  Check reached(const Stackability& measured) const;
  Check height(const CheckedDesign& checked) const;
  Check relations(const CheckedDesign& checked) const;
  Check proportions(const CheckedDesign& checked) const;
  Check box(const CheckedDesign& checked) const;
  Check parts(const CheckedDesign& checked) const;
  Check thickness(const CheckedDesign& checked) const;
  Check draft(const CheckedDesign& checked) const;
  Check standing(const CheckedDesign& checked) const;
  double displacement(const StayingPart& staying, const Design& design) const;

  const DeformationModel& space_;
  const Requirements& requirements_;
  std::vector<StayingPart> staying_;
  std::vector<ThicknessProbe> probes_;
  std::optional<QualityMeter> meter_;
};

}  // namespace stackabilization::detail
