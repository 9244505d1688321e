#include "improvement/quality/surface_marks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/index.h"
#include "mesh/barycentric.h"
#include "mesh/surface_index.h"
#include "mesh/surface_moments.h"
#include "structure/segmentation/surface_graph.h"

namespace stackabilization::detail {

void SurfaceMarks::append(const Shape& rest, std::int32_t triangle, const Eigen::Vector3d& point) {
  triangles.push_back(triangle);
  weights.push_back(barycentric_weights(rest, triangle, point));
}

void SurfaceMarks::append(const SurfaceMarks& others) {
  triangles.insert(triangles.end(), others.triangles.begin(), others.triangles.end());
  weights.insert(weights.end(), others.weights.begin(), others.weights.end());
}

void SurfaceMarks::append_corner(std::int32_t triangle, int corner) {
  triangles.push_back(triangle);
  weights.push_back(Eigen::Vector3d::Unit(corner));
}

Points SurfaceMarks::on(const Shape& shape) const {
  Points places(static_cast<Eigen::Index>(size()), 3);
  for (std::size_t k = 0; k < size(); ++k)
    places.row(static_cast<Eigen::Index>(k)) = point_at(shape, triangles[k], weights[k]).transpose();
  return places;
}

std::vector<std::vector<std::int32_t>> triangles_of_parts(const Shape& shape) {
  std::vector<std::vector<std::int32_t>> rows(static_cast<std::size_t>(shape.part_count()));
  for (std::int32_t t = 0; t < shape.triangle_count(); ++t) rows[at(shape.triangle_part[at(t)])].push_back(t);
  return rows;
}

SurfaceMarks marks_on(const Shape& rest, const std::vector<std::int32_t>& triangles, int count) {
  std::vector<std::int32_t> rows;
  for (const std::int32_t t : triangles)
    if (has_area(rest, t)) rows.push_back(t);
  SurfaceMarks marks;
  if (rows.empty()) return marks;
  const SurfaceSamples samples = surface_samples(extracted(rest, rows), count);
  for (std::size_t k = 0; k < samples.triangles.size(); ++k)
    marks.append(rest, rows[at(samples.triangles[k])],
                 samples.points.row(static_cast<Eigen::Index>(k)).transpose());
  return marks;
}

SurfaceMarks outermost_vertices(const Shape& rest, const std::vector<std::int32_t>& triangles) {
  SurfaceMarks marks;
  std::set<std::int32_t> known;
  for (const double x : {-1.0, 0.0, 1.0})
    for (const double y : {-1.0, 0.0, 1.0})
      for (const double z : {-1.0, 0.0, 1.0}) {
        const Eigen::Vector3d direction(x, y, z);
        if (direction.isZero()) continue;
        double height = -std::numeric_limits<double>::infinity();
        std::int32_t triangle = -1;
        int corner = 0;
        for (const std::int32_t t : triangles)
          for (int k = 0; k < 3; ++k)
            if (const double own = direction.dot(rest.corner(t, k)); own > height) {
              height = own;
              triangle = t;
              corner = k;
            }
        if (triangle >= 0 && known.insert(rest.triangles(triangle, corner)).second)
          marks.append_corner(triangle, corner);
      }
  return marks;
}

SurfaceMarks pieces_of(const Shape& rest, const std::vector<std::int32_t>& triangles, double length,
                       std::size_t max_pieces) {
  SurfaceMarks marks;
  std::size_t allowed = max_pieces;
  for (const std::int32_t t : triangles) {
    const double area = area_vector(rest, t).norm();
    double longest = 0;
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, (rest.corner(t, (k + 1) % 3) - rest.corner(t, k)).norm());
    // Each side is cut in n: n^2 pieces.
    const auto wanted = static_cast<std::size_t>(std::ceil(longest / length));
    const std::size_t n = std::clamp<std::size_t>(wanted, 1, 64);
    if (n * n > allowed) continue;
    allowed -= n * n;
    const auto add = [&](double a, double b) {
      marks.triangles.push_back(t);
      marks.weights.emplace_back(1 - a - b, a, b);
      marks.areas.push_back(area / static_cast<double>(n * n));
    };
    const double step = 1.0 / static_cast<double>(n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; i + j < n; ++j) {
        const double a = static_cast<double>(i) * step, b = static_cast<double>(j) * step;
        add(a + step / 3, b + step / 3);
        if (i + j + 1 < n) add(a + 2 * step / 3, b + 2 * step / 3);
      }
  }
  return marks;
}

}  // namespace stackabilization::detail
