#include "deformation/model/transfer.h"

#include "deformation/model/binding.h"

namespace stackabilization {

Eigen::Vector3d carried(const Primitive& rest, const Primitive& now, const Eigen::Vector3d& point) {
  const detail::Carrier carrier(rest);
  return carrier.carried(carrier.bind(point), now);
}

}  // namespace stackabilization
