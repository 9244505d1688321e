#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "stackabilization/structure/structure.h"

namespace stackabilization::detail {

/// Welded, non-degenerate triangles of a part with their edges, for part-part proximity.
class PartSurface {
 public:
  /// An edge with all triangles that share it.
  struct Edge {
    std::array<int, 2> vertices;
    std::vector<int> triangles;
  };

  /// `part` replaces a surface that is not closed in inside tests: the inside is then the inside of its
  /// primitive, provided that the primitive fits well.
  PartSurface(const Shape& surface, const Part& part);
  PartSurface(PartSurface&&) noexcept;
  ~PartSurface();

  const std::vector<Eigen::Vector3d>& points() const { return points_; }
  const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }
  const std::vector<Edge>& edges() const { return edges_; }
  /// Returns the lower corner of the axis-aligned box, model units.
  Eigen::Vector3d lowest() const { return lowest_; }
  /// Returns the upper corner of the axis-aligned box, model units.
  Eigen::Vector3d highest() const { return highest_; }
  /// Returns whether every edge has an even number of triangles, so that every point is either inside or
  /// outside.
  bool is_closed() const { return is_closed_; }
  /// Returns the diameter of the smallest ball around the part, model units. It does not depend on the pose.
  double size() const { return size_; }

  /// Returns whether `point` is inside. For a closed surface, a ray from an inner point meets the surface an
  /// odd number of times; the majority of three rays decides.
  bool contains(const Eigen::Vector3d& point) const;

  /// Computes the distance from `point` to the surface, model units. The cost is linear in the number of
  /// triangles.
  double distance(const Eigen::Vector3d& point) const;

 private:
  struct Tree;
  void collect_edges();

  std::vector<Eigen::Vector3d> points_;
  std::vector<std::array<int, 3>> triangles_;
  std::vector<Edge> edges_;
  Eigen::Vector3d lowest_, highest_;
  bool is_closed_ = true;
  double size_ = 0;
  std::unique_ptr<const Tree> tree_;
  std::function<bool(const Eigen::Vector3d&)> in_primitive_;
};

/// Computes the diameter of the smallest ball around the points, model units.
double enclosing_diameter(const std::vector<Eigen::Vector3d>& points);

}  // namespace stackabilization::detail
