#pragma once

#include <Eigen/Core>
#include <random>
#include <vector>

#include "support/solids.h"

namespace stackabilization::solids {

/// An upright box; shapes of such boxes have heights, gaps and spaces in closed form.
struct UprightBox {
  Eigen::Vector3d low, high;
};

/// Returns boxes of sides from 0.2 to 1.2, with low corners in [0, width] x [0, width] x [0, 1].
inline std::vector<UprightBox> random_boxes(int count, double width, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<UprightBox> boxes;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d low(width * unit(random), width * unit(random), unit(random));
    boxes.push_back({low, low + Eigen::Vector3d(0.2 + unit(random), 0.2 + unit(random), 0.2 + unit(random))});
  }
  return boxes;
}

/// Returns the shape of all boxes. Precondition: there is one.
inline Shape shape_of(const std::vector<UprightBox>& boxes) {
  Shape shape = box(boxes[0].low, boxes[0].high);
  for (std::size_t i = 1; i < boxes.size(); ++i) shape = concatenate(shape, box(boxes[i].low, boxes[i].high));
  return shape;
}

}  // namespace stackabilization::solids
