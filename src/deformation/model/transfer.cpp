#include "deformation/model/transfer.h"

#include "deformation/model/binding.h"

namespace stackabilization {

Eigen::Vector3d deform_point(const Primitive& rest, const Primitive& now, const Eigen::Vector3d& point) {
  const detail::PrimitiveBinding binding(rest);
  return binding.position_of(binding.bind(point), now);
}

}  // namespace stackabilization
