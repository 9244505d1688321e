#pragma once

#include <vector>

#include "improvement/requirements/thickness.h"
#include "stackabilization/improvement/requirements.h"

namespace stackabilization::detail {

/// A design stacked along r, with what was measured of it already.
struct CheckedDesign {
  const Design& design;
  const SeparationTree& tree;
  const Direction& direction;
  const Assessment& assessment;  ///< without its checks
};

/// Of a stack of so many copies, model units.
inline double stack_length(const StackRoom& room, const Stackability& measured) {
  return measured.extent + (room.copies - 1) * measured.f_max;
}

/// The checks of a RequirementChecker, with all that depends on the rest alone.
class RequirementChecks {
 public:
  /// `stay`: parts that may not change, in order. Precondition: the requirements are valid; both references
  /// outlive this.
  RequirementChecks(const DesignSpace& space, const Requirements& requirements, std::vector<int> stay);

  /// In the order of Check::name.
  std::vector<Check> of(const CheckedDesign& checked) const;

 private:
  struct StayingPart {
    int part = 0;
    std::vector<Eigen::Index> vertices;  ///< that have to stay
    bool by_primitive = false;           ///< its primitive has to stay as well
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

  const DesignSpace& space_;
  const Requirements& requirements_;
  std::vector<StayingPart> staying_;
  std::vector<ThicknessProbe> probes_;
};

}  // namespace stackabilization::detail
