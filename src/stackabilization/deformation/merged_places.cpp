#include "stackabilization/deformation/merged_places.h"

#include "stackabilization/shape/point_index.h"

namespace stackabilization::detail {

MergedPlaces merged_places(const Shape& shape) {
  MergedPlaces places;
  PointIndex index;
  for (Eigen::Index v = 0; v < shape.vertex_count(); ++v) {
    // Vertices that no triangle uses may hold anything.
    if (!shape.vertices.row(v).allFinite()) {
      places.of_vertex.push_back(-1);
      continue;
    }
    const std::int32_t place = index.insert(shape.vertices.row(v).transpose());
    if (static_cast<std::size_t>(place) == places.vertex_of.size())
      places.vertex_of.push_back(static_cast<std::int32_t>(v));
    places.of_vertex.push_back(place);
  }
  places.points = index.points();
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    std::array<int, 3> corners;
    for (int k = 0; k < 3; ++k)
      corners[static_cast<std::size_t>(k)] =
          places.of_vertex[static_cast<std::size_t>(shape.triangles(t, k))];
    places.triangles.push_back(corners);
  }
  return places;
}

}  // namespace stackabilization::detail
