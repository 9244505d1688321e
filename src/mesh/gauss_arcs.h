#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "stackabilization/mesh/boxes.h"

namespace stackabilization::detail {

/// Arc of the Gauss map: the directions between the normals of two neighbouring hull faces. A box along one
/// of them has the edge between the faces on its side.
struct GaussArc {
  int from, to;                 ///< faces
  Eigen::Vector3d start, side;  ///< unit, orthogonal: the arc begins at `start` and leads towards `side`
  double length;                ///< radians

  Eigen::Vector3d normal(double angle) const { return start * std::cos(angle) + side * std::sin(angle); }
};

/// Returns the arcs of a hull between faces whose normals are `wanted`. Opposite directions have the same
/// boxes: the middles of all arcs are on one side.
std::vector<GaussArc> gauss_arcs(const HullSupport& hull,
                                 const std::function<bool(const Eigen::Vector3d&)>& wanted);

/// Removes the arcs within 45 degrees of one of three orthogonal axes: of the one that has the most of them.
/// A minimal box has two normals on arcs (O'Rourke 1985), and of two orthogonal directions one at most is so
/// near an axis.
std::vector<GaussArc> without_needless_arcs(std::vector<GaussArc> arcs, const Eigen::Matrix3d& axes);

/// A tree over arcs: those of a node lie within an angle of its centre.
class GaussArcTree {
 public:
  struct Node {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< unit
    double radius = 0;                                 ///< radians
    int left = -1, right = -1;                         ///< nodes; -1 at a leaf
    int arc = -1;                                      ///< of a leaf, whose centre is the middle of the arc
  };

  explicit GaussArcTree(const std::vector<GaussArc>& arcs);

  /// Returns the nodes, the root first; none where there is no arc.
  const std::vector<Node>& nodes() const { return nodes_; }

 private:
  /// Arc with its middle and end.
  struct Entry {
    int arc;
    Eigen::Vector3d start, middle, end;
  };

  int build(std::size_t first, std::size_t last);

  std::vector<Entry> entries_;
  std::vector<Node> nodes_;
};

}  // namespace stackabilization::detail
