#include "stacking/validation/triangle_overlap.h"

#include <algorithm>
#include <array>
#include <vector>

namespace stackabilization::detail {

namespace {

Vector normal_of(const Corners& t) {
  return CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
}

std::array<int, 3> sides(const Corners& plane, const Corners& points) {
  std::array<int, 3> result;
  for (std::size_t k = 0; k < 3; ++k) result[k] = CGAL::orientation(plane[0], plane[1], plane[2], points[k]);
  return result;
}

bool on_both_sides(const std::array<int, 3>& side) {
  return std::min({side[0], side[1], side[2]}) < 0 && std::max({side[0], side[1], side[2]}) > 0;
}

struct Interval {
  Number low, high;
};

/// Returns the crossings of triangle t, with corners strictly on both sides of the plane of `plane`, as
/// parameters along `line`.
Interval crossing(const Corners& t, const Corners& plane, const Vector& line) {
  const Vector normal = normal_of(plane);
  std::array<Number, 3> distance, along;
  for (std::size_t k = 0; k < 3; ++k) {
    distance[k] = normal * (t[k] - plane[0]);
    along[k] = line * (t[k] - CGAL::ORIGIN);
  }
  std::vector<Number> found;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (CGAL::is_zero(distance[k])) found.push_back(along[k]);
    if (CGAL::sign(distance[k]) * CGAL::sign(distance[next]) < 0)
      found.push_back((along[k] * distance[next] - along[next] * distance[k]) /
                      (distance[next] - distance[k]));
  }
  return {std::min(found[0], found[1]), std::max(found[0], found[1])};
}

/// Returns whether the relative interiors of two triangles in different planes share a segment.
bool cross_properly(const Corners& a, const Corners& b) {
  if (!on_both_sides(sides(a, b)) || !on_both_sides(sides(b, a))) return false;
  const Vector line = CGAL::cross_product(normal_of(a), normal_of(b));
  const Interval in_a = crossing(a, b, line), in_b = crossing(b, a, line);
  return std::max(in_a.low, in_b.low) < std::min(in_a.high, in_b.high);
}

/// Returns the two coordinate axes onto which a triangle projects without degeneration, by its exact normal.
class Projection {
 public:
  explicit Projection(const Corners& t) {
    const Vector n = normal_of(t);
    for (int k = 0; k < 3; ++k)
      if (!CGAL::is_zero(n[k])) axis_ = k;
  }

  Exact::Point_2 operator()(const Point& p) const { return {p[(axis_ + 1) % 3], p[(axis_ + 2) % 3]}; }

 private:
  int axis_ = 0;
};

using ExactPolygon = std::vector<Exact::Point_2>;

/// Returns whether the line of some edge of `a` has all of `b` on its outer side or on itself.
bool separated_by_edge(const ExactPolygon& a, const ExactPolygon& b) {
  const CGAL::Orientation turn = CGAL::orientation(a[0], a[1], a[2]);
  for (std::size_t k = 0; k < 3; ++k) {
    bool outside = true;
    for (const Exact::Point_2& p : b)
      if (CGAL::orientation(a[k], a[(k + 1) % 3], p) == turn) outside = false;
    if (outside) return true;
  }
  return false;
}

ExactPolygon project(const Corners& t, const Projection& projection) {
  return {projection(t[0]), projection(t[1]), projection(t[2])};
}

/// Returns whether two triangles in one plane overlap in an area.
bool coplanar_overlap(const Corners& a, const Corners& b) {
  const Projection projection(a);
  const ExactPolygon in_a = project(a, projection), in_b = project(b, projection);
  return !separated_by_edge(in_a, in_b) && !separated_by_edge(in_b, in_a);
}

/// Returns whether the segment from p to q, in the plane of t, runs through the relative interior of t.
bool runs_inside(const Corners& t, const Point& p, const Point& q) {
  const Projection projection(t);
  const ExactPolygon triangle = project(t, projection);
  const ExactPolygon segment = {projection(p), projection(q)};
  std::array<int, 3> side;
  for (std::size_t k = 0; k < 3; ++k) side[k] = CGAL::orientation(segment[0], segment[1], triangle[k]);
  return on_both_sides(side) && !separated_by_edge(triangle, segment);
}

/// Returns whether t enters the solid at an edge inside t. Two neighbouring triangles of the solid meet in
/// this edge; `solid_corners` is one of them, and the edge starts at its corner `corner` and lies in the
/// plane of t.
bool enters_at_edge(const Corners& t, const Corners& solid_corners, std::size_t corner,
                    const Point& opposite) {
  const Point &p = solid_corners[corner], &q = solid_corners[(corner + 1) % 3];
  const int here = CGAL::orientation(t[0], t[1], t[2], solid_corners[(corner + 2) % 3]);
  const int there = CGAL::orientation(t[0], t[1], t[2], opposite);
  if (here * there > 0 || there == 0) return false;  // both faces on one side, or decided from the neighbour
  if (!runs_inside(t, p, q)) return false;
  if (here != 0) return true;
  // The face lies in the plane of t with the opposite orientation (the test for overlap in an area comes
  // before). The solid is on the side of t's normal, and t continues into it when the surface turns to the
  // other side.
  return there < 0;
}

bool enters_at_edges(const Corners& t, const Placed& solid, std::int32_t solid_triangle) {
  const Corners s = solid.corners(solid_triangle);
  const std::array<int, 3> side = sides(t, s);
  for (std::size_t k = 0; k < 3; ++k)
    if (side[k] == 0 && side[(k + 1) % 3] == 0 &&
        enters_at_edge(t, s, k,
                       solid.vertex(solid.surface.opposite[static_cast<std::size_t>(solid_triangle)][k])))
      return true;
  return false;
}

}  // namespace

bool overlap_near(const Placed& a, std::int32_t in_a, const Placed& b, std::int32_t in_b) {
  const Corners s = a.corners(in_a), t = b.corners(in_b);
  if (sides(s, t) == std::array<int, 3>{0, 0, 0}) {
    const bool same_way = CGAL::is_positive(normal_of(s) * normal_of(t));
    if (same_way) return coplanar_overlap(s, t);
  } else if (cross_properly(s, t)) {
    return true;
  }
  return enters_at_edges(s, b, in_b) || enters_at_edges(t, a, in_a);
}

bool is_inside(const Corners& t, const SolidLocator& solid) {
  // Points of t on a parabola, which meets a line or a point where t touches the solid at most twice: the
  // search ends.
  for (int attempt = 0;; ++attempt) {
    const PointLocation found = solid.locate(inner_point(t, attempt));
    if (found.place != PointPlace::boundary) return found.place == PointPlace::inside;
    if (sides(solid.corners(found.triangle), t) == std::array<int, 3>{0, 0, 0}) return false;
  }
}

}  // namespace stackabilization::detail
