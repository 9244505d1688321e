#pragma once

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>

#include <Eigen/Core>
#include <algorithm>
#include <boost/iterator/function_output_iterator.hpp>
#include <boost/variant.hpp>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// Converts a point to CGAL.
template <class Kernel>
typename Kernel::Point_3 to_cgal(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

/// A point of a surface and the triangle that contains it.
struct TreePoint {
  Eigen::Vector3d point;  ///< model units
  std::int32_t triangle;  ///< row of Shape::triangles
};

/// Triangles of a shape in CGAL's AABB tree. No other code of this library builds one. Results are as exact
/// as the predicates of the kernel. Safe to share between threads once built. Directions of rays have a
/// length of about 1.
template <class Kernel>
class TriangleTree {
 public:
  using Point = typename Kernel::Point_3;
  using Triangle = typename Kernel::Triangle_3;

  /// Builds the tree of the triangles `rows` of `shape`. Precondition: they have a positive area.
  TriangleTree(const Shape& shape, std::vector<std::int32_t> rows) : rows_(std::move(rows)) {
    triangles_.reserve(rows_.size());
    for (const std::int32_t t : rows_)
      triangles_.emplace_back(to_cgal<Kernel>(shape.corner(t, 0)), to_cgal<Kernel>(shape.corner(t, 1)),
                              to_cgal<Kernel>(shape.corner(t, 2)));
    tree_.insert(triangles_.cbegin(), triangles_.cend());
    tree_.build();
    if (!triangles_.empty()) ray_length_ = magnitude(box());
  }
  TriangleTree(const TriangleTree&) = delete;
  TriangleTree& operator=(const TriangleTree&) = delete;

  /// Returns the triangles in the tree, in the order of the constructor's `rows`.
  const std::vector<std::int32_t>& rows() const { return rows_; }
  /// Returns the box of all triangles. Precondition: there is a triangle.
  CGAL::Bbox_3 box() const { return tree_.bbox(); }

  /// Accelerates `nearest` for distant points. Call it before threads share the tree.
  void prepare_nearest() { tree_.accelerate_distance_queries(); }

  /// Returns the point of the surface that is nearest to `p`. Precondition: there is a triangle.
  TreePoint nearest(const Eigen::Vector3d& p) const {
    const auto [point, triangle] = tree_.closest_point_and_primitive(to_cgal<Kernel>(p));
    return {{point.x(), point.y(), point.z()}, rows_[entry(triangle)]};
  }

  /// Returns the first intersection of a ray with a triangle. Returns nothing when there is none, or when the
  /// first triangle is parallel to the ray.
  std::optional<TreePoint> first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
    const auto hit = tree_.first_intersection(ray(origin, direction));
    if (!hit) return std::nullopt;
    const Point* const point = held(hit->first);
    if (!point) return std::nullopt;
    return TreePoint{{point->x(), point->y(), point->z()}, rows_[entry(hit->second)]};
  }

  /// Returns whether a ray meets a triangle.
  bool is_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
    return tree_.do_intersect(ray(origin, direction));
  }

  /// Counts the triangles that a ray meets. The number is odd for an inner point of a closed surface, unless
  /// the ray meets an edge.
  std::size_t count_hits(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
    return count_met(ray(origin, direction));
  }

  /// Counts the triangles that a segment, ray or box of CGAL meets.
  template <class Query>
  std::size_t count_met(const Query& query) const {
    return tree_.number_of_intersected_primitives(query);
  }

  /// Appends the entries of `rows()` that a segment, ray or box of CGAL meets, in the order of the tree.
  template <class Query>
  void append_met(const Query& query, std::vector<std::size_t>& entries) const {
    tree_.all_intersected_primitives(query, boost::make_function_output_iterator(
                                                [&](const Entry& met) { entries.push_back(entry(met)); }));
  }

 private:
  using Entry = typename std::vector<Triangle>::const_iterator;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Entry>>>;

  /// A ray of CGAL is two points. They are apart by about the largest coordinate, so that rounding the second
  /// one turns no ray, whatever the unit of the shape.
  typename Kernel::Ray_3 ray(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
    const Eigen::Vector3d second = origin + ray_length_ * direction;
    return {to_cgal<Kernel>(origin), to_cgal<Kernel>(second)};
  }
  /// The largest absolute coordinate of the box, rounded down to a power of two; 1 if all are 0.
  static double magnitude(const CGAL::Bbox_3& box) {
    double largest = 0;
    for (int k = 0; k < 3; ++k) largest = std::max({largest, std::abs(box.min(k)), std::abs(box.max(k))});
    return largest > 0 ? std::exp2(std::ilogb(largest)) : 1;
  }
  std::size_t entry(const Entry& triangle) const {
    return static_cast<std::size_t>(triangle - triangles_.cbegin());
  }

  // CGAL answers with a variant of Boost before version 6, of the standard library from then on.
  template <class First, class... Others>
  static const Point* held(const boost::variant<First, Others...>& intersection) {
    return boost::get<Point>(&intersection);
  }
  template <class... Kinds>
  static const Point* held(const std::variant<Kinds...>& intersection) {
    return std::get_if<Point>(&intersection);
  }

  std::vector<std::int32_t> rows_;
  std::vector<Triangle> triangles_;  ///< one per entry of `rows_`
  Tree tree_;
  double ray_length_ = 1;  ///< distance of the two points of a ray, model units
};

}  // namespace stackabilization::detail
