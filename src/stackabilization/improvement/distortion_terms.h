#pragma once

#include <Eigen/Core>
#include <vector>

#include "stackabilization/improvement/energy.h"

namespace stackabilization::detail {

/// The changes that D (Eq. 6 to 10) adds up, with their signs: D is the sum of their magnitudes. D has a kink
/// wherever one of them vanishes, they themselves are smooth, and an optimiser can be told so.
///
/// Order: the volume of every part, the distance of every pair of parts, the sides of the box (with
/// BoxModel::oriented D_BB / 4 as one), D_symm / 4 as one. Const, safe from any number of threads.
class DistortionTerms {
 public:
  DistortionTerms(const StructuredShape& rest, BoxModel boxes);

  /// `distortion`: that of the design.
  Eigen::VectorXd changes(const Design& design, const Distortion& distortion) const;

 private:
  Eigen::VectorXd volumes(const std::vector<Primitive>& primitives) const;
  Eigen::VectorXd distances(const std::vector<Primitive>& primitives) const;

  BoxModel boxes_;
  std::vector<Primitive> primitives_;  ///< at rest
  Eigen::VectorXd volumes_, distances_;
  Eigen::Vector3d sides_;
};

}  // namespace stackabilization::detail
