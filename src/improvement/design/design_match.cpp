#include "improvement/design/design_match.h"

#include "stackabilization/core/errors.h"

namespace stackabilization::detail {

std::vector<Primitive> primitives_of(const Structure& structure) {
  std::vector<Primitive> primitives;
  for (const Part& part : structure.parts) primitives.push_back(part.primitive);
  return primitives;
}

void require_match(const Design& design, const std::vector<Primitive>& rest, Eigen::Index vertex_count) {
  bool same = design.primitives.size() == rest.size() && design.shape.vertex_count() == vertex_count;
  for (std::size_t i = 0; same && i < rest.size(); ++i)
    same = design.primitives[i].index() == rest[i].index() &&
           control_points(design.primitives[i]).rows() == control_points(rest[i]).rows();
  if (!same) throw UsageError("the design does not have the vertices and primitives of the shape at rest");
}

}  // namespace stackabilization::detail
