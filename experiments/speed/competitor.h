#pragma once

#include <functional>
#include <string>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/separation.h"

namespace stackabilization::experiments {

/// One way to find f_max of a shape in a direction, prepared once per shape: `measure` returns f_max in model
/// units. A maker gives nothing when its way does not apply to the shape.
struct Competitor {
  std::string name;
  ContactSemantics semantics = ContactSemantics::solid;  ///< whose f_max it looks for
  double build_seconds = 0;                              ///< of the processor
  std::function<double(const Direction&)> measure;
};

/// Bounding-volume bisection with FCL: from the top in 64 steps to the first collision, then to 1e-6 of the
/// extent. FCL counts touching as collision.
Competitor fcl_bisection(const Shape& shape);

/// Height field by Embree rays (single precision, robust mode): `resolution` samples along the longer side of
/// the projection, one ray from above and one from below each.
Competitor embree_rays(const Shape& shape, int resolution);

/// CGAL collision tests (exact predicates), searched from the top and bisected to 1e-6 of the extent: any
/// contact, or for closed surfaces also common interiors.
std::vector<Competitor> cgal_bisections(const Shape& shape);

}  // namespace stackabilization::experiments
