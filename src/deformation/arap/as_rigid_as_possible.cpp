#include "stackabilization/deformation/as_rigid_as_possible.h"

#include <CGAL/Deformation_Eigen_closest_rotation_traits_3.h>

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/disjoint_sets.h"
#include "mesh/surface_moments.h"
#include "stackabilization/deformation/tolerances.h"

namespace stackabilization {

namespace {

struct WeightedEdge {
  std::int32_t from, to;
  double weight;
};

/// Appends both directions of the three edges of a triangle, each with half the cotangent of the opposite
/// angle as weight.
void append_edges(const Points& points, const std::array<std::int32_t, 3>& corners,
                  std::vector<WeightedEdge>& edges) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int32_t apex = corners[k], from = corners[(k + 1) % 3], to = corners[(k + 2) % 3];
    if (from == to) continue;
    const Eigen::Vector3d a = (points.row(from) - points.row(apex)).transpose();
    const Eigen::Vector3d b = (points.row(to) - points.row(apex)).transpose();
    const double sine = a.cross(b).norm();
    const double weight = sine > 0 ? a.dot(b) / sine / 2 : 0;
    edges.push_back({from, to, weight});
    edges.push_back({to, from, weight});
  }
}

}  // namespace

RigidSurface::RigidSurface(Points points, const Triangles& triangles,
                           const std::vector<StitchingEdge>& stitches)
    : points_(std::move(points)) {
  add_edges(triangles, stitches);
  find_shells();
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const Eigen::Vector3d a = points_.row(triangles(t, 0));
    const Eigen::Vector3d b = points_.row(triangles(t, 1)), c = points_.row(triangles(t, 2));
    area_ += detail::area_vector(a, b, c).norm();
  }
}

void RigidSurface::add_edges(const Triangles& triangles, const std::vector<StitchingEdge>& stitches) {
  std::vector<WeightedEdge> edges;
  edges.reserve(6 * static_cast<std::size_t>(triangles.rows()));
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    append_edges(points_, {triangles(t, 0), triangles(t, 1), triangles(t, 2)}, edges);
  for (const StitchingEdge& stitch : stitches) {
    edges.push_back({stitch.a, stitch.b, stitch.weight});
    edges.push_back({stitch.b, stitch.a, stitch.weight});
  }
  // A stable sort adds the weights of both directions of an edge in the same order, so their sums are equal
  // bit for bit.
  std::stable_sort(edges.begin(), edges.end(), [](const WeightedEdge& a, const WeightedEdge& b) {
    return std::pair(a.from, a.to) < std::pair(b.from, b.to);
  });

  first_.assign(static_cast<std::size_t>(points_.rows()) + 1, 0);
  for (std::size_t k = 0; k < edges.size();) {
    const WeightedEdge& edge = edges[k];
    double weight = 0;
    for (; k < edges.size() && edges[k].from == edge.from && edges[k].to == edge.to; ++k)
      weight += edges[k].weight;
    const double bounded = std::clamp(weight, tolerance::edge_weight, 1 / tolerance::edge_weight);
    edges_.push_back({edge.to, bounded});
    ++first_[static_cast<std::size_t>(edge.from) + 1];
  }
  for (std::size_t p = 1; p < first_.size(); ++p) first_[p] += first_[p - 1];
}

void RigidSurface::find_shells() {
  const std::size_t count = first_.size() - 1;
  DisjointSets sets(count);
  for (std::size_t p = 0; p < count; ++p)
    for (const Edge* edge = begin(p); edge != end(p); ++edge)
      sets.join(p, static_cast<std::size_t>(edge->to));
  std::int32_t shells = 0;
  for (std::size_t p = 0; p < count; ++p) {
    const std::size_t root = sets.root(p);  // the least member
    shells_.push_back(root == p ? shells++ : shells_[root]);
  }
}

/// One run of the alternation: the unknown points, their factorized system, and the current points and
/// rotations.
class RigidSurface::Solution {
 public:
  Solution(const RigidSurface& surface, const std::vector<bool>& held, RotatedPoints start);

  void solve(const RigidityOptions& options) {
    if (free_.empty()) return;
    factorize();
    for (int k = 0; k < options.iterations; ++k) {
      update_points();
      update_rotations(options.rotation_smoothness);
    }
  }
  RotatedPoints result() && { return std::move(state_); }

 private:
  void factorize();
  void update_points();
  void update_rotations(double smoothness);
  Eigen::Vector3d rest(std::size_t from, const Edge& to) const {
    return (surface_.points_.row(static_cast<Eigen::Index>(from)) - surface_.points_.row(to.to)).transpose();
  }

  const RigidSurface& surface_;
  RotatedPoints state_;
  std::vector<Eigen::Index> column_;  ///< per point its column of the system; -1 where the position is known
  std::vector<std::size_t> free_;     ///< points by column
  std::vector<std::size_t> turning_;  ///< points that are free or have a free neighbour
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> system_;
};

RigidSurface::Solution::Solution(const RigidSurface& surface, const std::vector<bool>& held,
                                 RotatedPoints start)
    : surface_(surface), state_(std::move(start)), column_(held.size(), -1) {
  std::vector<bool> has_held(held.size());  // by shell
  for (std::size_t p = 0; p < held.size(); ++p)
    if (held[p]) has_held[static_cast<std::size_t>(surface.shells_[p])] = true;
  for (std::size_t p = 0; p < held.size(); ++p) {
    if (held[p]) continue;
    state_.points.row(static_cast<Eigen::Index>(p)) = surface.points_.row(static_cast<Eigen::Index>(p));
    if (!has_held[static_cast<std::size_t>(surface.shells_[p])]) continue;
    column_[p] = static_cast<Eigen::Index>(free_.size());
    free_.push_back(p);
  }
  const auto is_free = [&](std::size_t p) { return column_[p] >= 0; };
  for (std::size_t p = 0; p < held.size(); ++p)
    if (is_free(p) || std::any_of(surface.begin(p), surface.end(p),
                                  [&](const Edge& e) { return is_free(static_cast<std::size_t>(e.to)); }))
      turning_.push_back(p);
}

void RigidSurface::Solution::factorize() {
  std::vector<Eigen::Triplet<double>> entries;
  for (const std::size_t p : free_) {
    double diagonal = 0;
    for (const Edge* edge = surface_.begin(p); edge != surface_.end(p); ++edge) {
      diagonal += edge->weight;
      const Eigen::Index column = column_[static_cast<std::size_t>(edge->to)];
      if (column >= 0) entries.emplace_back(column_[p], column, -edge->weight);
    }
    entries.emplace_back(column_[p], column_[p], diagonal);
  }
  const auto size = static_cast<Eigen::Index>(free_.size());
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  system_.compute(matrix);
}

/// Global step: solves for displacements from rest. With identity rotations its right side is exactly zero.
void RigidSurface::Solution::update_points() {
  Eigen::Matrix<double, Eigen::Dynamic, 3> right(static_cast<Eigen::Index>(free_.size()), 3);
  for (const std::size_t p : free_) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Edge* edge = surface_.begin(p); edge != surface_.end(p); ++edge) {
      const auto q = static_cast<std::size_t>(edge->to);
      const Eigen::Matrix3d mean = (state_.rotations[p] + state_.rotations[q]) / 2;
      sum += edge->weight * ((mean - Eigen::Matrix3d::Identity()) * rest(p, *edge));
      if (column_[q] < 0)
        sum += edge->weight * (state_.points.row(edge->to) - surface_.points_.row(edge->to)).transpose();
    }
    right.row(column_[p]) = sum.transpose();
  }
  const Eigen::Matrix<double, Eigen::Dynamic, 3> moved = system_.solve(right);
  for (const std::size_t p : free_) {
    const auto row = static_cast<Eigen::Index>(p);
    state_.points.row(row) = surface_.points_.row(row) + moved.row(column_[p]);
  }
}

/// Local step: computes, for each point, the rotation nearest to the change of its edges.
void RigidSurface::Solution::update_rotations(double smoothness) {
  CGAL::Deformation_Eigen_closest_rotation_traits_3 closest;
  std::vector<Eigen::Matrix3d> rotations;
  rotations.reserve(turning_.size());
  for (const std::size_t p : turning_) {
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero(), neighbours = Eigen::Matrix3d::Zero();
    for (const Edge* edge = surface_.begin(p); edge != surface_.end(p); ++edge) {
      const auto now = state_.points.row(static_cast<Eigen::Index>(p)) - state_.points.row(edge->to);
      covariance += edge->weight * (rest(p, *edge) * now);
      neighbours += state_.rotations[static_cast<std::size_t>(edge->to)];
    }
    const auto degree = static_cast<double>(surface_.end(p) - surface_.begin(p));
    covariance += (smoothness * surface_.area_ / degree) * neighbours.transpose();
    closest.compute_close_rotation(covariance, rotations.emplace_back());
  }
  for (std::size_t k = 0; k < turning_.size(); ++k) state_.rotations[turning_[k]] = rotations[k];
}

RotatedPoints RigidSurface::deformed(const std::vector<bool>& held, RotatedPoints start,
                                     const RigidityOptions& options) const {
  Solution solution(*this, held, std::move(start));
  solution.solve(options);
  return std::move(solution).result();
}

}  // namespace stackabilization
