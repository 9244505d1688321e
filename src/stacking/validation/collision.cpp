#include "stackabilization/stacking/collision.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "stackabilization/core/errors.h"
#include "stacking/measure/exact_number.h"
#include "stacking/validation/exact_body.h"
#include "stacking/validation/triangle_overlap.h"

namespace stackabilization {

namespace {

using detail::Corners;
using detail::Exact;
using detail::ExactBody;
using detail::Number;
using detail::Placed;
using detail::Point;
using detail::Vector;

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
    if (is_inside(t, solid)) found = true;
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
