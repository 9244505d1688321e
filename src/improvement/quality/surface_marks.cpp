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

namespace {

/// Ratio of the lengths of pieces that are tried, where there would be too many.
constexpr double coarser = 1.25;

}  // namespace

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
  if (triangles.size() > max_pieces) {
    double area = 0;
    for (const std::int32_t t : triangles) area += area_vector(rest, t).norm();
    SurfaceMarks marks = marks_on(rest, triangles, static_cast<int>(max_pieces));
    marks.areas.assign(marks.size(), area / static_cast<double>(max_pieces));
    return marks;
  }
  std::vector<double> longest;
  for (const std::int32_t t : triangles) {
    double edge = 0;
    for (int k = 0; k < 3; ++k)
      edge = std::max(edge, (rest.corner(t, (k + 1) % 3) - rest.corner(t, k)).norm());
    longest.push_back(edge);
  }
  // Each side is cut in n: n^2 pieces.
  const auto cuts = [&](double edge) {
    return static_cast<std::size_t>(std::clamp(std::ceil(edge / length), 1.0, 64.0));
  };
  const auto count = [&] {
    std::size_t pieces = 0;
    for (const double edge : longest) pieces += cuts(edge) * cuts(edge);
    return pieces;
  };
  while (count() > max_pieces) length *= coarser;
  SurfaceMarks marks;
  for (std::size_t row = 0; row < triangles.size(); ++row) {
    const std::int32_t t = triangles[row];
    const std::size_t n = cuts(longest[row]);
    const double area = area_vector(rest, t).norm() / static_cast<double>(n * n);
    const auto add = [&](double a, double b) {
      marks.triangles.push_back(t);
      marks.weights.emplace_back(1 - a - b, a, b);
      marks.areas.push_back(area);
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
