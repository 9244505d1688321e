#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "stackabilization/structure/structure.h"

namespace stackabilization::detail {

/// The surface of a part as what meets others: its triangles of positive area with their corners and edges,
/// points of equal coordinates being one.
class PartSurface {
 public:
  struct Edge {
    std::array<int, 2> vertices;
    std::vector<int> triangles;
  };

  /// `part` stands in for a surface that is not closed: what its primitive holds is inside then, where it
  /// fits well.
  PartSurface(const Shape& surface, const Part& part);
  PartSurface(PartSurface&&) noexcept;
  ~PartSurface();

  const std::vector<Eigen::Vector3d>& points() const { return points_; }
  const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }
  const std::vector<Edge>& edges() const { return edges_; }
  Eigen::Vector3d lowest() const { return lowest_; }
  Eigen::Vector3d highest() const { return highest_; }
  /// Whether every edge has an even number of triangles, so that each point is inside or outside.
  bool is_closed() const { return is_closed_; }
  /// Diameter of the smallest ball around the part, model units: its size in any pose.
  double size() const { return size_; }

  /// For closed surfaces whether a ray from `point` meets the surface oddly often, the majority of three
  /// rays.
  bool contains(const Eigen::Vector3d& point) const;

  /// Distance from `point` to the surface, model units; looks at every triangle.
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

/// Diameter of the smallest ball around points, model units.
double enclosing_diameter(const std::vector<Eigen::Vector3d>& points);

}  // namespace stackabilization::detail
