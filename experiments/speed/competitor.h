#pragma once

#include <functional>
#include <string>
#include <vector>

#include "stackabilization/shape/direction.h"
#include "stackabilization/shape/shape.h"

namespace stackabilization::experiments {

/// One way to find f_max of a shape in a direction, prepared once per shape: `measure` returns f_max in model
/// units.
struct Competitor {
  std::string name;
  double build_seconds = 0;
  std::function<double(const Direction&)> measure;
};

/// Bounding-volume bisection with FCL: from the top in 64 steps to the first collision, then to 1e-6 of the
/// extent. FCL counts touching as collision.
Competitor fcl_bisection(const Shape& shape);

/// Height field by Embree rays (single precision, robust mode): `resolution` samples along the longer side of
/// the projection, one ray from above and one from below each.
Competitor embree_rays(const Shape& shape, int resolution);

/// CGAL collision tests (exact predicates), searched from the top and bisected to 1e-6 of the extent.
Competitor cgal_bisection(const Shape& shape);

}  // namespace stackabilization::experiments
