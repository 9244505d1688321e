#include "stackabilization/stacking/collision.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "stackabilization/core/errors.h"
#include "stackabilization/mesh/closed_surface.h"
#include "stacking/measure/exact_number.h"
#include "stacking/validation/solid_location.h"

namespace stackabilization {

namespace {

using detail::Corners;
using detail::Exact;
using detail::Number;
using detail::Point;
using detail::Vector;

/// A placed shape: exact coordinates of all vertices.
struct Placed {
  const Shape& shape;
  const ClosedSurface& surface;
  std::vector<Point> points;

  std::size_t triangle_count() const { return static_cast<std::size_t>(shape.triangle_count()); }
  const Point& vertex(std::int32_t v) const { return points[static_cast<std::size_t>(v)]; }
  Corners corners(std::int32_t t) const {
    return {vertex(shape.triangles(t, 0)), vertex(shape.triangles(t, 1)), vertex(shape.triangles(t, 2))};
  }
};

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

/// Returns whether these two touching triangles and their neighbours alone prove that the interiors overlap.
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

/// Returns whether the relative interior of t, which the surface of the solid does not cross, runs inside the
/// solid. The function tests points of t on a parabola. The parabola meets a line or a point where t touches
/// the solid at most twice, so the search ends.
bool inside(const Corners& t, const detail::SolidLocator& solid) {
  for (int attempt = 0;; ++attempt) {
    const detail::PointLocation found = solid.locate(detail::inner_point(t, attempt));
    if (found.place != detail::PointPlace::boundary) return found.place == detail::PointPlace::inside;
    if (sides(solid.corners(found.triangle), t) == std::array<int, 3>{0, 0, 0}) return false;
  }
}

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

/// A shape with its data that do not depend on the placement. Of triangles with equal keys, as in coincident
/// parts, only the first one is tested.
struct ExactBody {
  Shape shape;
  ClosedSurface surface;
  detail::SolidLocator solid;
  std::vector<std::int32_t> first;     ///< per triangle with area the first that is the same, else -1
  std::vector<std::int32_t> distinct;  ///< those, ascending

  explicit ExactBody(const Shape& source)
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

  static std::size_t index(std::int32_t row) { return static_cast<std::size_t>(row); }

  bool is_distinct(std::int32_t row) const { return first[index(row)] == row; }

  Placed moved(const Vector& translation) const {
    Placed placed{shape, surface, std::vector<Point>(static_cast<std::size_t>(shape.vertex_count()))};
    for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d p = shape.corner(t, k);
        placed.points[static_cast<std::size_t>(shape.triangles(t, k))] =
            Point(p.x(), p.y(), p.z()) + translation;
      }
    return placed;
  }

  /// Returns the triangles that may lie inside another solid although no triangle crosses its surface: the
  /// triangles that touch it, and one triangle of every component. Neighbours that do not touch it are on the
  /// same side.
  std::vector<std::int32_t> candidates(const std::vector<std::atomic<bool>>& touched) const {
    std::vector<std::int32_t> rows;
    for (const std::int32_t row : surface.representatives)
      rows.push_back(first[index(row)] < 0 ? row : first[index(row)]);
    for (std::size_t t = 0; t < touched.size(); ++t)
      if (touched[t]) rows.push_back(static_cast<std::int32_t>(t));
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    return rows;
  }
};

}  // namespace

struct CollisionTester::Data {
  ExactBody below, above;

  Data(const Shape& fixed, const Shape& lifted) : below(fixed), above(lifted) {}

  /// Distinct triangles of `below` whose boxes meet that of a triangle of the lifted shape.
  std::vector<std::int32_t> near(const Corners& t) const {
    std::vector<std::int32_t> found = below.solid.triangles_in(t[0].bbox() + t[1].bbox() + t[2].bbox());
    std::erase_if(found, [&](std::int32_t row) { return !below.is_distinct(row); });
    return found;
  }

  /// Throws InputError when more than `max_collision_pairs` pairs would have to be tested.
  void require_bounded_pairs(const Placed& lifted) const {
    if (above.distinct.size() * below.distinct.size() <= std::size_t{max_collision_pairs}) return;
    std::atomic<std::int64_t> pairs = 0;
    tbb::parallel_for(std::size_t{0}, above.distinct.size(), [&](std::size_t k) {
      if (pairs <= max_collision_pairs)
        pairs += static_cast<std::int64_t>(near(lifted.corners(above.distinct[k])).size());
    });
    if (pairs > max_collision_pairs)
      throw InputError("more than " + std::to_string(max_collision_pairs) +
                       " pairs of triangles come near each other: collisions are tested between so many");
  }

  /// Calls visit(triangle of below, triangle of above) for pairs of distinct triangles that touch, in any
  /// order and in parallel, until a call returns true. Returns whether a call did.
  template <class Visitor>
  bool any_touching_pair(const Placed& fixed, const Placed& lifted, const Visitor& visit) const {
    require_bounded_pairs(lifted);
    std::atomic<bool> found = false;
    tbb::parallel_for(std::size_t{0}, above.distinct.size(), [&](std::size_t k) {
      if (found) return;
      const std::int32_t in_above = above.distinct[k];
      const Corners t = lifted.corners(in_above);
      for (const std::int32_t in_below : near(t)) {
        const Corners s = fixed.corners(in_below);
        if (!CGAL::do_intersect(Exact::Triangle_3(s[0], s[1], s[2]), Exact::Triangle_3(t[0], t[1], t[2])))
          continue;
        if (found || visit(in_below, in_above)) {
          found = true;
          return;
        }
      }
    });
    return found;
  }
};

namespace {

Vector translation_by(const Direction& direction, const Rational& lift) {
  const Number t(to_exact<Exact::Exact_kernel::FT>(lift));
  const Eigen::Vector3d& r = direction.vector();
  return {t * r.x(), t * r.y(), t * r.z()};
}

/// Returns whether the winding numbers beside one point of every triangle are not negative, and no surfaces
/// cancel each other where they enclose nothing on one side.
std::optional<InteriorDefect> winding_defect(const ExactBody& body) {
  if (body.distinct.size() * body.solid.rows().size() > std::size_t{max_collision_pairs}) {
    std::atomic<std::int64_t> pairs = 0;
    tbb::parallel_for(std::size_t{0}, body.distinct.size(), [&](std::size_t k) {
      if (pairs <= max_collision_pairs) pairs += body.solid.count_beside(body.distinct[k]);
    });
    if (pairs > max_collision_pairs) return InteriorDefect::undecided;
  }
  std::atomic<bool> negative = false, cancelled = false;
  tbb::parallel_for(std::size_t{0}, body.distinct.size(), [&](std::size_t k) {
    if (negative) return;
    const detail::Windings beside = body.solid.windings_beside(body.distinct[k]);
    if (std::min(beside.ahead, beside.behind) < 0) negative = true;
    const bool is_outer = beside.ahead == 0 || beside.behind == 0;
    if (is_outer && (beside.opposed || beside.ahead == beside.behind)) cancelled = true;
  });
  if (negative) return InteriorDefect::inside_out;
  if (cancelled) return InteriorDefect::no_volume;
  return std::nullopt;
}

/// Returns whether some triangle among `candidates`, moved by `by`, is inside the solid.
bool any_inside(const Placed& shape, const std::vector<std::int32_t>& candidates, const Vector& by,
                const detail::SolidLocator& solid) {
  std::atomic<bool> found = false;
  tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t k) {
    if (found) return;
    Corners t = shape.corners(candidates[k]);
    for (Point& corner : t) corner = corner + by;
    if (inside(t, solid)) found = true;
  });
  return found;
}

}  // namespace

CollisionTester::CollisionTester(const Shape& below, const Shape& above)
    : data_(std::make_unique<const Data>(below, above)) {}
CollisionTester::CollisionTester(CollisionTester&&) noexcept = default;
CollisionTester& CollisionTester::operator=(CollisionTester&&) noexcept = default;
CollisionTester::~CollisionTester() = default;

bool CollisionTester::solids() const {
  return data_->below.surface.closed && data_->above.surface.closed;
}

std::optional<InteriorDefect> CollisionTester::interior_defect() const {
  if (!solids()) return InteriorDefect::open;
  for (const ExactBody* body : {&data_->below, &data_->above})
    if (const auto defect = winding_defect(*body)) return defect;
  return std::nullopt;
}

const Shape& CollisionTester::below() const {
  return data_->below.shape;
}

const Shape& CollisionTester::above() const {
  return data_->above.shape;
}

bool CollisionTester::closed_contact(const Direction& direction, const Rational& lift) const {
  const Placed fixed = data_->below.moved(CGAL::NULL_VECTOR);
  const Placed lifted = data_->above.moved(translation_by(direction, lift));
  return data_->any_touching_pair(fixed, lifted, [](std::int32_t, std::int32_t) { return true; });
}

bool CollisionTester::interiors_overlap(const Direction& direction, const Rational& lift) const {
  if (!solids())
    throw InputError("the interiors of an open or non-manifold shape cannot be tested for overlap");
  const Vector by = translation_by(direction, lift);
  const Placed fixed = data_->below.moved(CGAL::NULL_VECTOR), lifted = data_->above.moved(by);

  std::vector<std::atomic<bool>> below_touched(fixed.triangle_count()),
      above_touched(lifted.triangle_count());
  const bool certain =
      data_->any_touching_pair(fixed, lifted, [&](std::int32_t in_below, std::int32_t in_above) {
        below_touched[ExactBody::index(in_below)] = true;
        above_touched[ExactBody::index(in_above)] = true;
        return overlap_near(fixed, in_below, lifted, in_above);
      });
  return certain ||
         any_inside(lifted, data_->above.candidates(above_touched), CGAL::NULL_VECTOR, data_->below.solid) ||
         any_inside(fixed, data_->below.candidates(below_touched), -by, data_->above.solid);
}

bool closed_contact(const Shape& below, const Shape& above, const Direction& direction,
                    const Rational& lift) {
  return CollisionTester(below, above).closed_contact(direction, lift);
}

bool interiors_overlap(const Shape& below, const Shape& above, const Direction& direction,
                       const Rational& lift) {
  return CollisionTester(below, above).interiors_overlap(direction, lift);
}

}  // namespace stackabilization
