#include "stacking/validation/solid_location.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <utility>

#include "mesh/triangle_tree.h"
#include "stackabilization/mesh/exact_triangles.h"

namespace stackabilization::detail {

namespace {

using Filtered = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Relation of a ray to a triangle.
enum class Meeting {
  passed,     ///< not met
  crossed,    ///< met in its interior
  starts_on,  ///< the ray starts in its interior, and leaves its plane
  undecided   ///< the ray runs in its plane or meets its outline
};

/// The winding is 1 where the normal goes along the ray, -1 where against it.
struct RayMeeting {
  Meeting meeting = Meeting::passed;
  int winding = 0;
};

/// A ray up along a coordinate axis or, with a slope, along (1, slope, slope^2).
struct Ray {
  int axis = 0;
  int slope = 0;  ///< of axis 0 only

  /// The plane that the ray is a point of, turned so that the axis points at who looks.
  Exact::Point_2 flat(const Point& q) const {
    if (slope > 0) return {q.y() - slope * q.x(), q.z() - slope * slope * q.x()};
    return {q[(axis + 1) % 3], q[(axis + 2) % 3]};
  }
  /// Tries the three axes first, because few triangles are near an axis-parallel ray.
  static Ray number(int k) { return k < 3 ? Ray{k, 0} : Ray{0, k - 2}; }
};

/// Returns the meeting of the ray from p with triangle t.
RayMeeting ray_meeting(const Point& p, const Ray& ray, const Corners& t) {
  const Exact::Point_2 a = ray.flat(t[0]), b = ray.flat(t[1]), c = ray.flat(t[2]), q = ray.flat(p);
  const std::array<int, 3> side = {CGAL::orientation(a, b, q), CGAL::orientation(b, c, q),
                                   CGAL::orientation(c, a, q)};
  const auto [least, most] = std::minmax({side[0], side[1], side[2]});
  if (least < 0 && most > 0) return {};
  if (least == 0 && most == 0) return {Meeting::undecided, 0};  // the ray runs in the plane of t
  const int above_plane = CGAL::orientation(t[0], t[1], t[2], p);
  const bool on_outline = least == 0 || most == 0;
  if (above_plane == 0) return {Meeting::starts_on, on_outline ? 0 : side[0]};
  if (on_outline) return {Meeting::undecided, 0};
  // Seen against the ray, the triangle is counter-clockwise (side = 1): its normal points along the ray, and
  // the ray meets it when it starts behind it.
  return above_plane * side[0] < 0 ? RayMeeting{Meeting::crossed, side[0]} : RayMeeting{};
}

}  // namespace

struct SolidLocator::Tree : TriangleTree<Filtered> {
  using TriangleTree::TriangleTree;
};

SolidLocator::SolidLocator(const Shape& solid)
    : solid_(solid), tree_(std::make_unique<const Tree>(solid, triangles_with_area(solid))) {}

SolidLocator::~SolidLocator() = default;

const std::vector<std::int32_t>& SolidLocator::rows() const {
  return tree_->rows();
}

Corners SolidLocator::corners(std::int32_t triangle) const {
  Corners corners;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d p = solid_.corner(triangle, k);
    corners[static_cast<std::size_t>(k)] = Point(p.x(), p.y(), p.z());
  }
  return corners;
}

std::vector<std::int32_t> SolidLocator::triangles_in(const CGAL::Bbox_3& box) const {
  std::vector<std::size_t> met;
  tree_->append_met(box, met);
  std::vector<std::int32_t> found;
  for (const std::size_t entry : met) found.push_back(rows()[entry]);
  std::sort(found.begin(), found.end());
  return found;
}

namespace {

/// The box of a ray in `all`: it never descends along an axis, and ascends along one only without a slope.
CGAL::Bbox_3 box_of(const Point& p, const Ray& ray, const CGAL::Bbox_3& all) {
  const CGAL::Bbox_3 from = p.bbox();
  const auto end = [&](int k) {
    const bool ascends = k == ray.axis || ray.slope > 0;
    return ascends ? std::max(from.max(k), all.max(k)) : from.max(k);
  };
  return {from.xmin(), from.ymin(), from.zmin(), end(0), end(1), end(2)};
}

/// The axis that is least along a triangle.
int axis_across(const Corners& t) {
  const Vector normal = CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (CGAL::abs(CGAL::to_double(normal[k])) > CGAL::abs(CGAL::to_double(normal[axis]))) axis = k;
  if (!CGAL::is_zero(normal[axis])) return axis;
  while (CGAL::is_zero(normal[axis])) axis = (axis + 1) % 3;  // where doubles are too coarse
  return axis;
}

}  // namespace

/// Ends: a plane through p and an edge of the solid holds (1, slope, slope^2) for two slopes at most.
PointLocation SolidLocator::locate(const Point& p) const {
  if (rows().empty()) return {};
  for (int k = 0;; ++k) {
    const Ray ray = Ray::number(k);
    int winding = 0;
    bool decided = true;
    for (const std::int32_t t : triangles_in(box_of(p, ray, tree_->box()))) {
      const RayMeeting met = ray_meeting(p, ray, corners(t));
      if (met.meeting == Meeting::starts_on) return {PointPlace::boundary, t};
      if (met.meeting == Meeting::undecided) {
        decided = false;
        break;
      }
      winding += met.winding;
    }
    if (decided) return {winding == 0 ? PointPlace::outside : PointPlace::inside};
  }
}

Point inner_point(const Corners& corner, int attempt) {
  const Number u = Number(271) / (997 + attempt);
  return corner[0] + u * (corner[1] - corner[0]) + u * u * (corner[2] - corner[0]);
}

std::int64_t SolidLocator::count_beside(std::int32_t triangle) const {
  const Corners corner = corners(triangle);
  const Ray ray{axis_across(corner), 0};
  const CGAL::Bbox_3 box = box_of(inner_point(corner, 0), ray, tree_->box());
  return static_cast<std::int64_t>(tree_->count_met(box));
}

/// Tries points on a parabola in the triangle, which meets what an edge of the solid looks like from the axis
/// twice at most: so this ends.
Windings SolidLocator::windings_beside(std::int32_t triangle) const {
  const Corners corner = corners(triangle);
  const Ray ray{axis_across(corner), 0};
  for (int attempt = 0;; ++attempt) {
    const Point p = inner_point(corner, attempt);
    Windings found;
    bool decided = true, up = false, down = false;
    for (const std::int32_t t : triangles_in(box_of(p, ray, tree_->box()))) {
      const RayMeeting met = ray_meeting(p, ray, corners(t));
      decided = met.meeting != Meeting::undecided && (met.meeting != Meeting::starts_on || met.winding != 0);
      if (!decided) break;
      (met.meeting == Meeting::starts_on ? found.behind : found.ahead) += met.winding;
      if (met.meeting == Meeting::starts_on) (met.winding > 0 ? up : down) = true;
    }
    if (decided) return {found.ahead, found.ahead + found.behind, up && down};
  }
}

}  // namespace stackabilization::detail
