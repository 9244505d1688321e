#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Options of RigidSurface::deformed.
struct RigidityOptions {
  int iterations = 10;  ///< number of alternations between rotations and points, >= 1
  /// Weight of the term that makes the rotations of neighbours equal, in units of the surface's area, >= 0
  /// (Levi and Gotsman 2015, smooth rotation enhanced). 0 gives the plain method, whose rotations stay small
  /// and local.
  double rotation_smoothness = 0;
};

/// Positions of the points of a surface, with the rotation of the surface around each point.
struct RotatedPoints {
  Points points;                           ///< n x 3 positions, model units
  std::vector<Eigen::Matrix3d> rotations;  ///< n rotations relative to the rest pose
};

/// An additional edge, besides those of the triangles.
struct StitchingEdge {
  std::int32_t a, b;  ///< rows of two different points
  double weight;      ///< edge weight, about 1 as for other edges
};

/// As-rigid-as-possible deformation of a surface (Sorkine and Alexa 2007). Some points are held. The
/// positions of the free points minimise the deviation of the surface around every point from a rotation of
/// its rest pose. Edges are weighted by cotangents.
///
/// The method needs only the edges of the surface, so an edge may have one triangle, two or many: sheets that
/// meet in an edge or a point deform together and without cracks. On manifold surfaces without obtuse pairs
/// of angles the method is that of CGAL's Surface_mesh_deformation with ORIGINAL_ARAP, which accepts
/// half-edge meshes only. Immutable, safe to share between threads, deterministic.
class RigidSurface {
 public:
  /// `points`: n x 3, all different, model units. `triangles`: rows of `points`. Triangles without area still
  /// connect their corners, by weak edges. `ties`: additional edges.
  RigidSurface(Points points, const Triangles& triangles, const std::vector<StitchingEdge>& ties = {});

  /// Returns the shell (connected component) of every point: n numbers, counted from 0 in the order of the
  /// points. Edges of triangles and ties connect points.
  const std::vector<std::int32_t>& shells() const { return shells_; }

  /// Computes the deformed points and their rotations. `held`: n flags. `start` contains the positions of the
  /// held points and initial guesses of all rotations; the positions of its free points are ignored.
  ///
  /// Shells without a held point stay at rest and keep the rotations of `start`. Held points are returned bit
  /// for bit. Free points are in their rest positions when all held points are in theirs and all guesses are
  /// the identity. Points that are not finite indicate an overflow.
  RotatedPoints deformed(const std::vector<bool>& held, RotatedPoints start,
                         const RigidityOptions& options = {}) const;

 private:
  struct Edge {
    std::int32_t to;
    double weight;
  };
  class Solution;

  void add_edges(const Triangles& triangles, const std::vector<StitchingEdge>& ties);
  void find_shells();
  const Edge* begin(std::size_t point) const { return edges_.data() + first_[point]; }
  const Edge* end(std::size_t point) const { return edges_.data() + first_[point + 1]; }

  Points points_;
  /// Per point the index of its first edge in `edges_`; the last entry is the end.
  std::vector<std::size_t> first_;
  std::vector<Edge> edges_;
  std::vector<std::int32_t> shells_;
  double area_ = 0;
};

}  // namespace stackabilization
