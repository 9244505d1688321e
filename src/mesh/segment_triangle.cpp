#include "mesh/segment_triangle.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace stackabilization::detail {

namespace {

/// Parameter along `segment`, in [0, 1], of its point nearest to the line through p and q.
double nearest_to_line(const Segment& segment, const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
  const Eigen::Vector3d d = segment[1] - segment[0], e = q - p, between = segment[0] - p;
  const double dd = d.squaredNorm(), ee = e.squaredNorm(), de = d.dot(e);
  const double determinant = dd * ee - de * de;
  if (!(determinant > 0)) return 0;
  return std::clamp((de * e.dot(between) - ee * d.dot(between)) / determinant, 0.0, 1.0);
}

}  // namespace

Eigen::Vector3d nearest_on_triangle(const Eigen::Vector3d& point, const Corners& triangle) {
  const auto& [a, b, c] = triangle;
  const Eigen::Vector3d ab = b - a, ac = c - a, ap = point - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Eigen::Vector3d bp = point - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  const Eigen::Vector3d cp = point - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  return a + (vb * ab + vc * ac) / (va + vb + vc);
}

Approach approach(const Segment& segment, const Corners& triangle, double resolution) {
  const Eigen::Vector3d d = segment[1] - segment[0];
  // The distance is convex along the segment. Its minimum, and the ends of an interval of minimal distance,
  // are among the ends of the segment, the projections of the corners, the points nearest to the sides, and
  // the intersection with the plane.
  std::array<double, 9> places{};
  places[1] = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    places[2 + k] = std::clamp(d.dot(triangle[k] - segment[0]) / d.squaredNorm(), 0.0, 1.0);
    places[5 + k] = nearest_to_line(segment, triangle[k], triangle[(k + 1) % 3]);
  }
  const Eigen::Vector3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  const double from = normal.dot(segment[0] - triangle[0]), to = normal.dot(segment[1] - triangle[0]);
  places[8] = (from < 0) != (to < 0) ? from / (from - to) : 0;

  std::array<double, 9> distances{};
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Eigen::Vector3d p = segment[0] + places[k] * d;
    distances[k] = (nearest_on_triangle(p, triangle) - p).norm();
  }
  Approach result{*std::min_element(distances.begin(), distances.end()), 1, 0};
  for (std::size_t k = 0; k < places.size(); ++k)
    if (distances[k] <= result.distance + resolution) {
      result.low = std::min(result.low, places[k]);
      result.high = std::max(result.high, places[k]);
    }
  return result;
}

}  // namespace stackabilization::detail
