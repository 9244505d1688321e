#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Options of RigidSurface::deformed.
struct RigidityOptions {
  int iterations = 10;  ///< of the alternation between rotations and points; >= 1
  /// Weight, in units of the surface's area, with which the rotations of neighbours are made alike (Levi and
  /// Gotsman 2015, smooth rotation enhanced). 0 is the plain method, and turns small and local; >= 0.
  double rotation_smoothness = 0;
};

/// Points with the rotation of the surface around each of them.
struct RotatedPoints {
  Points points;                           ///< n x 3, model units
  std::vector<Eigen::Matrix3d> rotations;  ///< n
};

/// An edge besides those of the triangles.
struct Tie {
  std::int32_t a, b;  ///< two different points
  double weight;      ///< about one, as of other edges
};

/// As-rigid-as-possible deformation of a surface (Sorkine and Alexa 2007): of all positions of the free
/// points with some points held, those for which the surface around every point is as near as possible to a
/// rotation of what it was, edges weighted by cotangents.
///
/// Needs of the surface nothing but its edges, so an edge may have one triangle, two or many: sheets that
/// meet in an edge or a point deform together and without cracks. On manifold surfaces without obtuse pairs
/// of angles it is CGAL's Surface_mesh_deformation with ORIGINAL_ARAP, which takes half-edge meshes only.
/// Immutable, safe to share between threads, deterministic.
class RigidSurface {
 public:
  /// `triangles` are rows of `points`, which are all different. Triangles without area hang on by weak edges.
  RigidSurface(Points points, const Triangles& triangles, const std::vector<Tie>& ties = {});

  /// Points of equal numbers are connected by edges; numbered from 0 in order of the points.
  const std::vector<std::int32_t>& shells() const { return shells_; }

  /// `start` holds the positions of the points with `held`, and first guesses of all rotations; positions of
  /// free points are not looked at. Shells of which no point is held stay, their rotations too. Held points
  /// come back to the bit, and free ones in their rest positions when all held ones are in theirs and all
  /// guesses are the identity. Points that are not finite tell that numbers have overflowed.
  RotatedPoints deformed(const std::vector<bool>& held, RotatedPoints start,
                         const RigidityOptions& options = {}) const;

 private:
  struct Edge {
    std::int32_t to;
    double weight;
  };
  class Solution;

  void add_edges(const Triangles& triangles, const std::vector<Tie>& ties);
  void find_shells();
  const Edge* begin(std::size_t point) const { return edges_.data() + first_[point]; }
  const Edge* end(std::size_t point) const { return edges_.data() + first_[point + 1]; }

  Points points_;
  std::vector<std::size_t> first_;  ///< per point its first entry of `edges_`, and the end
  std::vector<Edge> edges_;
  std::vector<std::int32_t> shells_;
  double area_ = 0;
};

}  // namespace stackabilization
