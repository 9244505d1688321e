#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "deformation/controllers/mesh_transfer.h"
#include "deformation/controllers/relation_solver.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/deformation/edit.h"

namespace stackabilization::detail {

/// Bounds of the extent of a mesh along one direction.
struct ExtentBound {
  Eigen::Vector3d normal;       ///< unit direction
  double low = 0, high = 0;     ///< bounds of the extent, model units; equal when the extent is kept
  std::optional<double> level;  ///< height of the lower end, when it is fixed; the extent is kept then
};

/// Returns the bounds that `keep_extent` and `box_tolerance` impose on a shape. Throws UsageError when the
/// tolerance is negative or not finite.
std::vector<ExtentBound> extent_bounds(const Shape& rest, const DeformationConstraints& constraints);

/// Returns, per part, the rows of the vertices that its triangles use, ascending.
std::vector<std::vector<int>> vertices_by_part(const Shape& shape);
/// Returns, per class, the rows of the vertices that the triangles of its parts use, ascending.
std::vector<std::vector<int>> vertices_by_class(const Shape& shape, const Rig& rig);

/// Converts violated bounds into constraints on the outermost vertices of a mesh.
class ActiveExtentConstraints {
 public:
  /// `groups`: one list of ascending vertices for each set of parts that move alike. It must outlive this
  /// object.
  ActiveExtentConstraints(const std::vector<std::vector<int>>& groups, std::vector<ExtentBound> bounds)
      : groups_(groups), bounds_(std::move(bounds)) {}

  const std::vector<ExtentBound>& bounds() const { return bounds_; }
  /// Returns the violation of bound `k`, model units: positive when the extent is too long, negative when it
  /// is too short, 0 within half of tolerance::relative of the extent. With fixed ends it is the violation of
  /// the end that is farther off, positive outwards.
  double excess(std::size_t k, const Points& vertices) const;
  bool any_excess(const Points& vertices) const;
  /// Returns the heights of the mesh along the normal of bound `k` (`range`), and the heights that the bound
  /// demands when it is kept (`wanted`).
  Range range(std::size_t k, const Points& vertices) const;
  Range wanted(std::size_t k, const Points& vertices) const;
  /// Returns whether bound `k` keeps the extent, that is, allows a single length.
  bool is_kept(std::size_t k) const { return bounds_[k].low == bounds_[k].high; }
  /// Returns the lowest heights along the normals of all bounds: levels from which a solve starts.
  Eigen::VectorXd levels(const Points& vertices) const;

  /// Treatment of the held vertices of a group when another vertex of the group becomes outermost.
  enum class OnExchange { release, keep };
  /// Holds the extent at the violated bound: on either side, the outermost vertex of every group that reaches
  /// into the excess. Returns false when this adds no vertex to the held ones or, with OnExchange::release,
  /// to those ever held.
  bool hold(std::size_t k, const Points& vertices, OnExchange on_exchange);
  /// Returns the constraints that keep the held vertices at their heights.
  std::vector<Constraint> constraints(const MeshTransfer& transfer) const;
  /// Forgets all held vertices, also those held earlier, so that they may be held again.
  void release();

 private:
  /// Held vertices of one group on one side of a bound.
  struct Held {
    std::set<int> vertices;  ///< vertices held now
    std::set<int> ever;      ///< vertices held now or earlier
    double height = 0;       ///< height as in Constraint
  };

  bool hold_side(std::size_t k, bool upper, const Points& vertices, OnExchange on_exchange);

  const std::vector<std::vector<int>>& groups_;
  std::vector<ExtentBound> bounds_;
  std::map<std::tuple<std::size_t, bool, std::size_t>, Held> held_;  ///< key: bound, upper side, group
};

}  // namespace stackabilization::detail
