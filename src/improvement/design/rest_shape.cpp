#include "stackabilization/improvement/rest_shape.h"

namespace stackabilization {

RestShape::RestShape(const StructuredShape& rest, const StackabilityOptions& measure)
    : solver_(rest.shape, measure), without_play_(solver_.with_play(0)), meter_(rest, solver_.box().axes) {}

Stackability RestShape::measure(const Direction& direction) const {
  // With the boxes of the file a solver rounds the extent in another way.
  return options().boxes == BoxModel::oriented ? solver_.measure(direction)
                                               : stackability(shape(), direction, options());
}

}  // namespace stackabilization
