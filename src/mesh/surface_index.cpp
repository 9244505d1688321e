#include "mesh/surface_index.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

using Cartesian = CGAL::Simple_cartesian<double>;
using CartesianTriangle = Cartesian::Triangle_3;
using TrianglePrimitive =
    CGAL::AABB_triangle_primitive<Cartesian, std::vector<CartesianTriangle>::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Cartesian, TrianglePrimitive>>;

Cartesian::Point_3 to_cgal(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

Eigen::Vector3d double_area_normal(const Shape& shape, Eigen::Index t) {
  return (shape.corner(t, 1) - shape.corner(t, 0)).cross(shape.corner(t, 2) - shape.corner(t, 0));
}

[[noreturn]] void no_area() {
  throw InputError("the surface has no triangle of positive area");
}

}  // namespace

struct SurfaceIndex::Data {
  std::vector<CartesianTriangle> triangles;
  std::vector<std::int32_t> rows;  ///< per entry of `triangles`
  Tree tree;
};

SurfaceIndex::SurfaceIndex(const Shape& shape) {
  auto data = std::make_unique<Data>();
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    if (!(double_area_normal(shape, t).norm() > 0)) continue;
    data->triangles.emplace_back(to_cgal(shape.corner(t, 0)), to_cgal(shape.corner(t, 1)),
                                 to_cgal(shape.corner(t, 2)));
    data->rows.push_back(static_cast<std::int32_t>(t));
  }
  if (data->triangles.empty()) no_area();
  data->tree.insert(data->triangles.cbegin(), data->triangles.cend());
  data->tree.build();
  // Hints for far points; built now, so that queries from several threads change nothing.
  data->tree.accelerate_distance_queries();
  data_ = std::move(data);
}

SurfaceIndex::SurfaceIndex(SurfaceIndex&&) noexcept = default;
SurfaceIndex& SurfaceIndex::operator=(SurfaceIndex&&) noexcept = default;
SurfaceIndex::~SurfaceIndex() = default;

SurfacePoint SurfaceIndex::nearest(const Eigen::Vector3d& point) const {
  const auto [place, triangle] = data_->tree.closest_point_and_primitive(to_cgal(point));
  const Eigen::Vector3d nearest(place.x(), place.y(), place.z());
  return {data_->rows[static_cast<std::size_t>(triangle - data_->triangles.cbegin())], nearest,
          (nearest - point).norm()};
}

SurfaceSamples surface_samples(const Shape& shape, int count) {
  const Eigen::Index m = shape.triangle_count();
  Eigen::VectorXd ends(m);  // running sum of areas
  double area = 0;
  for (Eigen::Index t = 0; t < m; ++t) ends(t) = area += double_area_normal(shape, t).norm() / 2;
  if (!(area > 0)) no_area();

  SurfaceSamples samples{Points(count, 3), Points(count, 3),
                         std::vector<std::int32_t>(static_cast<std::size_t>(count))};
  Eigen::Index t = 0;
  for (int k = 0; k < count; ++k) {
    const double wanted = (k + 0.5) / count * area;
    while (t + 1 < m && ends(t) < wanted) ++t;
    // The R2 sequence (Roberts 2018), folded from the square to the triangle.
    constexpr double plastic = 1.32471795724474602596;
    double u = std::fmod(0.5 + (k + 1) / plastic, 1.0),
           v = std::fmod(0.5 + (k + 1) / (plastic * plastic), 1.0);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const Eigen::Vector3d origin = shape.corner(t, 0);
    samples.points.row(k) =
        (origin + u * (shape.corner(t, 1) - origin) + v * (shape.corner(t, 2) - origin)).transpose();
    samples.normals.row(k) = double_area_normal(shape, t).normalized().transpose();
    samples.triangles[static_cast<std::size_t>(k)] = static_cast<std::int32_t>(t);
  }
  return samples;
}

}  // namespace stackabilization
