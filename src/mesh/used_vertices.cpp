#include "mesh/used_vertices.h"

#include <algorithm>
#include <vector>

namespace stackabilization {

Points used_vertices(const Shape& shape) {
  std::vector<char> used(shape.vertex_count(), 0);
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    for (int corner = 0; corner < 3; ++corner) used[shape.triangles(t, corner)] = 1;
  Points points(std::count(used.begin(), used.end(), 1), 3);
  Eigen::Index row = 0;
  for (Eigen::Index v = 0; v < shape.vertex_count(); ++v)
    if (used[v]) points.row(row++) = shape.vertices.row(v);
  return points;
}

}  // namespace stackabilization
