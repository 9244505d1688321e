#include "stackabilization/stacking/stack.h"

#include <algorithm>
#include <limits>

#include "stackabilization/core/errors.h"
#include "stackabilization/mesh/boxes.h"
#include "stacking/stacks/stack_boxes.h"

namespace stackabilization {

Line box_axis(const Shape& shape, const Direction& direction, BoxModel boxes) {
  const HullSupport hull(shape);
  const OrientedBox box =
      boxes == BoxModel::oriented ? hull.box_along(direction) : frame_box(hull.points(), direction);
  return {box.centre, direction};
}

StackResult stack_copies(const Shape& shape, const Direction& direction, const StackOptions& options) {
  StackPairs pairs(shape, direction, options);
  const StackBoxes boxes(shape, direction, options.boxes);
  return build_stack(pairs, pairs.sequence(), options.copies, boxes);
}

Copies stacked_copies(const Shape& shape, const Direction& direction, const StackResult& stack) {
  Copies copies{{shape}, {}};
  for (const StackedCopy& copy : stack.copies) {
    const Eigen::Vector3d lift = copy.offset.to_double() * direction.vector();
    copies.placed.push_back({"copy" + std::to_string(copies.placed.size() + 1), copy.transform.rotation,
                             copy.transform.translation + lift});
  }
  return copies;
}

Shape stacked_shape(const Shape& shape, const Direction& direction, const StackResult& stack) {
  return as_one_shape(stacked_copies(shape, direction, stack));
}

}  // namespace stackabilization
