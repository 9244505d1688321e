#include "deformation/model/places.h"

#include <Eigen/Geometry>
#include <Eigen/QR>

#include "mesh/point_index.h"

namespace stackabilization::detail {

double Places::area(Eigen::Index triangle) const {
  const Eigen::Vector3d a = points.row(triangles(triangle, 0));
  const Eigen::Vector3d b = points.row(triangles(triangle, 1)), c = points.row(triangles(triangle, 2));
  return (b - a).cross(c - a).norm() / 2;
}

Places places_of(const Shape& shape) {
  Places places;
  places.of_vertex.assign(static_cast<std::size_t>(shape.vertex_count()), -1);
  places.triangles.resize(shape.triangle_count(), 3);
  PointIndex index;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::int32_t vertex = shape.triangles(t, k);
      std::int32_t& place = places.of_vertex[static_cast<std::size_t>(vertex)];
      if (place < 0) place = index.insert(shape.vertices.row(vertex).transpose());
      if (static_cast<std::size_t>(place) == places.vertex.size()) places.vertex.push_back(vertex);
      places.triangles(t, k) = place;
    }
  places.points = shape.vertices(places.vertex, Eigen::all);
  return places;
}

Eigen::Vector3d corner_weights(const Shape& shape, const SurfacePoint& at) {
  const Eigen::Vector3d a = shape.corner(at.triangle, 0);
  Eigen::Matrix<double, 3, 2> sides;
  sides << shape.corner(at.triangle, 1) - a, shape.corner(at.triangle, 2) - a;
  const Eigen::Vector2d w = sides.colPivHouseholderQr().solve(at.point - a);
  return {1 - w(0) - w(1), w(0), w(1)};
}

}  // namespace stackabilization::detail
