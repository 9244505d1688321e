#pragma once

#include "stackabilization/improvement/requirements.h"

namespace stackabilization::cups {

/// All cups with conical walls of height 4, circles of some radius at the bottom and at the top, 1 at the top
/// at rest, and walls whose thickness is a tenth of the radius everywhere. Section 0 is the bottom, 1 the
/// top; they can be scaled, and everything is straight between them. Nothing else can be edited.
///
/// Where the inner wall reaches the rim, f = height wall top / (top - bottom) for cups that open upwards, so
/// that S = 1 - wall top / (top - bottom) in `frame` boxes, as long as the bottom goes into the mouth.
class Cups : public DeformationModel {
 public:
  static constexpr double wall = 0.1, height = 4;

  /// `foot`: radius at the bottom at rest.
  explicit Cups(int segments = 16, double foot = 1);

  const StructuredShape& rest() const override { return rest_; }
  DeformationKind kind() const override { return DeformationKind::controllers; }
  std::vector<Handle> handles() const override;
  Eigen::Vector3d centre(const Handle& handle) const override;
  /// Refuses what is no scaling of a section, and fixed parts.
  DeformationResult edited(const Design& now, const Edit& edit,
                           const DeformationConstraints& constraints) const override;

 private:
  int segments_;
  StructuredShape rest_;
};

inline const Cups space;

/// Asks `space` for frame boxes and a stackability.
RequirementChecker checker(double target);

/// Radii at the bottom and at the top.
Eigen::Vector2d radii(const Design& design);

Edit scale(int section, double factor);

}  // namespace stackabilization::cups
