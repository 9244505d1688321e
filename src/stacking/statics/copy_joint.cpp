#include "stacking/statics/copy_joint.h"

#include <cmath>

#include "stackabilization/core/errors.h"

namespace stackabilization::detail {

CopyJoint copy_joint(const Shape& shape, const Direction& direction, ContactSemantics semantics,
                     double band) {
  const SeparationTree tree(shape);
  const Separation separation =
      stackabilization::separation(tree, tree, direction, {semantics, std::nullopt});
  if (!separation.blocked)
    throw InputError("copies of the shape pass each other along the direction, so none rests on another");
  const ContactOptions options{.semantics = semantics, .band = band};
  return {separation.length, contact_regions({shape, tree, direction, separation}, options).regions};
}

void check_statics(double band, const std::optional<double>& friction,
                   const std::optional<Eigen::Vector3d>& up, const Direction& direction) {
  if (!(band > 0 && band < 1)) throw UsageError("the band of points that carry must lie between 0 and 1");
  if (friction && !(std::isfinite(*friction) && *friction >= 0))
    throw UsageError("a coefficient of friction is a finite number of at least 0");
  if (up && !(up->dot(direction.vector()) > 0))
    throw UsageError("a stack that stands goes upwards: its direction must not point down or sideways");
}

}  // namespace stackabilization::detail
