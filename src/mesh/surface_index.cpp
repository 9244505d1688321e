#include "mesh/surface_index.h"

#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>
#include <cmath>
#include <utility>
#include <vector>

#include "mesh/surface_moments.h"
#include "mesh/triangle_tree.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

[[noreturn]] void no_area() {
  throw InputError("the surface has no triangle of positive area");
}

}  // namespace

struct SurfaceIndex::Data {
  detail::TriangleTree<CGAL::Simple_cartesian<double>> tree;

  Data(const Shape& shape, std::vector<std::int32_t> rows) : tree(shape, std::move(rows)) {
    // Built now, so that queries from several threads change nothing.
    tree.prepare_nearest();
  }
};

SurfaceIndex::SurfaceIndex(const Shape& shape) {
  std::vector<std::int32_t> rows;
  for (std::int32_t t = 0; t < shape.triangle_count(); ++t)
    if (detail::area_vector(shape, t).norm() > 0) rows.push_back(t);
  if (rows.empty()) no_area();
  data_ = std::make_unique<const Data>(shape, std::move(rows));
}

SurfaceIndex::SurfaceIndex(SurfaceIndex&&) noexcept = default;
SurfaceIndex& SurfaceIndex::operator=(SurfaceIndex&&) noexcept = default;
SurfaceIndex::~SurfaceIndex() = default;

SurfacePoint SurfaceIndex::nearest(const Eigen::Vector3d& point) const {
  const detail::TreePoint found = data_->tree.nearest(point);
  return {found.triangle, found.point, (found.point - point).norm()};
}

SurfaceSamples surface_samples(const Shape& shape, int count) {
  const Eigen::Index m = shape.triangle_count();
  Eigen::VectorXd ends(m);  // running sum of areas
  double area = 0;
  for (Eigen::Index t = 0; t < m; ++t) ends(t) = area += detail::area_vector(shape, t).norm();
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
    samples.normals.row(k) = detail::area_vector(shape, t).normalized().transpose();
    samples.triangles[static_cast<std::size_t>(k)] = static_cast<std::int32_t>(t);
  }
  return samples;
}

}  // namespace stackabilization
