#include "stackabilization/rendering/foot.h"

namespace stackabilization {

Eigen::Vector3d foot_of(const Shape& shape, const Direction& direction) {
  const Frame frame = frame_of(direction);
  const Range u = range_along(shape, frame.u), v = range_along(shape, frame.v);
  return frame.to_world({(u.low + u.high) / 2, (v.low + v.high) / 2, range_along(shape, frame.w).low});
}

Shape on_ground(const Shape& shape, const Direction& direction) {
  return transformed(shape, Eigen::Matrix3d::Identity(), -foot_of(shape, direction));
}

}  // namespace stackabilization
