#include "stacking/place/local_frame.h"

#include <algorithm>

namespace stackabilization::detail {
namespace {

/// The triangles in the frame of r, and no vertex that they do not use.
Shape in_frame(const Shape& shape, const Frame& frame) {
  Shape local = shape.part_count() == 1 ? extract_part(shape, 0) : shape;
  Eigen::Matrix3d axes;
  axes << frame.u.transpose(), frame.v.transpose(), frame.w.transpose();
  local.vertices = axes == Eigen::Matrix3d::Identity() ? local.vertices : local.vertices * axes.transpose();
  return local;
}

}  // namespace

Outline::Outline(const Shape& local) {
  const Range x = range_along(local, Eigen::Vector3d::UnitX()),
              y = range_along(local, Eigen::Vector3d::UnitY());
  low = {x.low, y.low};
  high = {x.high, y.high};
}

LocalShapes::LocalShapes(const Shape& base_shape, const Shape& moving_shape, const Direction& direction)
    : base(in_frame(base_shape, frame_of(direction))), shape(in_frame(moving_shape, frame_of(direction))) {
  centre = Outline(shape).centre();
  shape.vertices.leftCols<2>().rowwise() -= centre.transpose();
  size = std::max(base.vertices.cwiseAbs().maxCoeff(), shape.vertices.cwiseAbs().maxCoeff());
}

}  // namespace stackabilization::detail
