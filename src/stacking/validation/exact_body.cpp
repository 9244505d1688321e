#include "stacking/validation/exact_body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>

#include "stackabilization/core/errors.h"

namespace stackabilization::detail {

namespace {

/// Six times the signed volume, about a corner of the shape.
double signed_volume(const Shape& shape) {
  const Eigen::Vector3d origin = shape.corner(0, 0);
  double volume = 0;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    volume +=
        (shape.corner(t, 0) - origin).dot((shape.corner(t, 1) - origin).cross(shape.corner(t, 2) - origin));
  return volume;
}

/// Returns the shape, with all triangles reversed when it is inside out as a whole.
Shape outward(Shape shape) {
  validate(shape);
  if (signed_volume(shape) < 0) shape.triangles.col(1).swap(shape.triangles.col(2));
  return shape;
}

/// Key of a triangle: its corners from the smallest one on and, for a closed surface, the opposite corners of
/// its neighbours in the same order. A test depends on these only.
using TriangleKey = std::array<std::array<double, 3>, 6>;

TriangleKey key_of(const Shape& shape, const ClosedSurface& surface, std::int32_t t) {
  const auto point = [&](std::int32_t vertex) {
    return std::array{shape.vertices(vertex, 0), shape.vertices(vertex, 1), shape.vertices(vertex, 2)};
  };
  std::array<std::array<double, 3>, 3> corners;
  for (int k = 0; k < 3; ++k) corners[static_cast<std::size_t>(k)] = point(shape.triangles(t, k));
  const auto first =
      static_cast<std::size_t>(std::min_element(corners.begin(), corners.end()) - corners.begin());
  TriangleKey key{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t from = (first + k) % 3;
    key[k] = corners[from];
    if (surface.closed) key[3 + k] = point(surface.opposite[static_cast<std::size_t>(t)][from]);
  }
  return key;
}

}  // namespace

ExactBody::ExactBody(const Shape& source)
    : shape(outward(source)),
      surface(closed_surface(shape)),
      solid(shape),
      first(static_cast<std::size_t>(shape.triangle_count()), -1) {
  std::vector<std::pair<TriangleKey, std::int32_t>> keys;
  for (const std::int32_t row : solid.rows()) keys.emplace_back(key_of(shape, surface, row), row);
  std::sort(keys.begin(), keys.end());
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const bool repeats = k > 0 && keys[k].first == keys[k - 1].first;
    const std::int32_t row = keys[k].second;
    first[index(row)] = repeats ? first[index(keys[k - 1].second)] : row;
    if (!repeats) distinct.push_back(row);
  }
  std::sort(distinct.begin(), distinct.end());
}

Placed ExactBody::moved(const Vector& translation) const {
  Placed placed{shape, surface, std::vector<Point>(static_cast<std::size_t>(shape.vertex_count()))};
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d p = shape.corner(t, k);
      placed.points[static_cast<std::size_t>(shape.triangles(t, k))] =
          Point(p.x(), p.y(), p.z()) + translation;
    }
  return placed;
}

std::vector<std::int32_t> ExactBody::candidates(const std::vector<std::atomic<bool>>& touched) const {
  std::vector<std::int32_t> rows;
  for (const std::int32_t row : surface.representatives)
    rows.push_back(first[index(row)] < 0 ? row : first[index(row)]);
  for (std::size_t t = 0; t < touched.size(); ++t)
    if (touched[t]) rows.push_back(static_cast<std::int32_t>(t));
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

}  // namespace stackabilization::detail
