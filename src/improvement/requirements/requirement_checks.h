#pragma once

#include <optional>
#include <vector>

#include "improvement/quality/thickness.h"
#include "stackabilization/improvement/requirements.h"

namespace stackabilization::detail {

/// A design stacked along r.
struct StackedDesign {
  const Design& design;
  const SeparationTree& tree;
  const Direction& direction;
  const Separation& separation;  ///< exact, of two copies without clearance and play
};

/// Checks of a RequirementChecker, with everything that depends on the shape at rest alone.
class RequirementChecks {
 public:
  /// `stay`: parts that may not change, ascending. Preconditions: the requirements are valid; both references
  /// outlive this object.
  RequirementChecks(const DeformationModel& space, const Requirements& requirements, std::vector<int> stay);

  /// Checks the target or the room.
  Check reached(const Stackability& measured) const;
  /// Makes the required checks that need one copy alone, in the order of CheckKind; quality is not among
  /// them.
  std::vector<Check> of_one_copy(const Design& design, const Direction& direction) const;
  /// Returns whether a check of contacts is required.
  bool need_contacts() const;
  /// Makes the required checks of contacts, in the order of CheckKind.
  std::vector<Check> of_contacts(const StackedDesign& stacked) const;
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

  Check height(const Shape& shape, const Direction& direction) const;
  Check relations(const Design& design) const;
  Check proportions(const Design& design) const;
  Check box(const Shape& shape) const;
  Check parts(const Design& design) const;
  Check thickness(const Shape& shape) const;
  Check draft(const StackedDesign& stacked) const;
  Check standing(const StackedDesign& stacked) const;
  Check jam(const StackedDesign& stacked) const;
  Check resting(const StackedDesign& stacked) const;
  double displacement(const StayingPart& staying, const Design& design) const;

  const DeformationModel& space_;
  const Requirements& requirements_;
  std::vector<StayingPart> staying_;
  std::vector<ThicknessProbe> probes_;
  std::optional<QualityMeter> meter_;
};

}  // namespace stackabilization::detail
