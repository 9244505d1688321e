#include "stackabilization/improvement/carried_design.h"

#include <utility>

#include "deformation/carried/carried_primitives.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {

Design carried_design(const StructuredShape& rest, Shape deformed) {
  validate(rest);
  if (deformed.vertex_count() != rest.shape.vertex_count() ||
      deformed.triangle_count() != rest.shape.triangle_count() || deformed.triangles != rest.shape.triangles)
    throw UsageError("a mesh is a design of a shape only when it has the same vertices and triangles");
  std::vector<Primitive> primitives = detail::CarriedPrimitives(rest).at(deformed.vertices);
  return {{}, std::move(primitives), std::move(deformed)};
}

}  // namespace stackabilization
