#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "stackabilization/core/shape.h"

/// Connected surfaces of box-shaped solids with a known part per face.
namespace stackabilization::solids {

/// A box on the integer grid: [low, high).
struct GridBox {
  std::array<int, 3> low, high;
};

/// The surface of the union of boxes, closed and outward oriented, two triangles per unit square. Each square
/// has the part of the first box that holds the unit cube behind it; parts are called "box_0" and on.
Shape grid_union(const std::vector<GridBox>& boxes);

}  // namespace stackabilization::solids
