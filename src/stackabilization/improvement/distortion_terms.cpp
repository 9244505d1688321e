#include "stackabilization/improvement/distortion_terms.h"

#include "stackabilization/shape/boxes.h"

namespace stackabilization::detail {

namespace {

Eigen::Vector3d sides(const Shape& shape) {
  Eigen::Vector3d result;
  for (int axis = 0; axis < 3; ++axis)
    result[axis] = range_along(shape, Eigen::Vector3d::Unit(axis)).length();
  return result;
}

/// now - rest over the sum of rest, a quarter of it: what one of the four terms of D adds up.
Eigen::VectorXd relative_change(const Eigen::VectorXd& rest, const Eigen::VectorXd& now) {
  const double sum = rest.sum();
  if (!(sum > 0)) return Eigen::VectorXd::Zero(rest.size());
  return (now - rest) / (4 * sum);
}

}  // namespace

DistortionTerms::DistortionTerms(const StructuredShape& rest, BoxModel boxes)
    : boxes_(boxes), sides_(sides(rest.shape)) {
  for (const Part& part : rest.structure.parts) primitives_.push_back(part.primitive);
  volumes_ = volumes(primitives_);
  distances_ = distances(primitives_);
}

Eigen::VectorXd DistortionTerms::volumes(const std::vector<Primitive>& primitives) const {
  Eigen::VectorXd result(static_cast<Eigen::Index>(primitives.size()));
  for (std::size_t p = 0; p < primitives.size(); ++p)
    result[static_cast<Eigen::Index>(p)] = volume(primitives[p]);
  return result;
}

Eigen::VectorXd DistortionTerms::distances(const std::vector<Primitive>& primitives) const {
  const auto count = static_cast<Eigen::Index>(primitives.size());
  Eigen::VectorXd result(count * (count - 1) / 2);
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < primitives.size(); ++i)
    for (std::size_t j = i + 1; j < primitives.size(); ++j)
      result[row++] = axis_distance(primitives[i], primitives[j]);
  return result;
}

Eigen::VectorXd DistortionTerms::changes(const Design& design, const Distortion& distortion) const {
  const Eigen::VectorXd volume = relative_change(volumes_, volumes(design.primitives));
  const Eigen::VectorXd distance = relative_change(distances_, distances(design.primitives));
  const Eigen::VectorXd box = boxes_ == BoxModel::frame
                                  ? Eigen::VectorXd(relative_change(sides_, sides(design.shape)))
                                  : Eigen::VectorXd::Constant(1, distortion.box / 4);
  Eigen::VectorXd result(volume.size() + distance.size() + box.size() + 1);
  result << volume, distance, box, distortion.symmetry / 4;
  return result;
}

}  // namespace stackabilization::detail
