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
  Eigen::Vector3d normal;       ///< unit
  double low = 0, high = 0;     ///< model units; equal to keep the extent
  std::optional<double> level;  ///< height at which it begins, where that is fixed: it is kept then
};

/// What `keep_extent` and `box_tolerance` demand of a shape. Throws UsageError when the tolerance is negative
/// or not finite.
std::vector<ExtentBound> extent_bounds(const Shape& rest, const DeformationConstraints& constraints);

/// Rows of the vertices that the triangles of each part use, ascending.
std::vector<std::vector<int>> vertices_by_part(const Shape& shape);
/// The same of all parts of each class.
std::vector<std::vector<int>> vertices_by_class(const Shape& shape, const Rig& rig);

/// Turns bounds that a mesh breaks into constraints on its outermost vertices.
class ExtentWatch {
 public:
  /// `groups` has the vertices of parts that move alike, ascending; it must outlive this.
  ExtentWatch(const std::vector<std::vector<int>>& groups, std::vector<ExtentBound> bounds)
      : groups_(groups), bounds_(std::move(bounds)) {}

  const std::vector<ExtentBound>& bounds() const { return bounds_; }
  /// By how much the extent passes bound `k`, model units: above zero too long, below too short, 0 within
  /// half of tolerance::relative of what is demanded. Where the ends are fixed, the farthest that one of them
  /// is off.
  double excess(std::size_t k, const Points& vertices) const;
  bool any_excess(const Points& vertices) const;
  /// Heights of the mesh along the normal of bound `k`, and what they are to be where it leaves no choice.
  Range range(std::size_t k, const Points& vertices) const;
  Range wanted(std::size_t k, const Points& vertices) const;
  /// Whether bound `k` leaves no choice.
  bool is_kept(std::size_t k) const { return bounds_[k].low == bounds_[k].high; }
  /// Lowest heights along the normals of the bounds: levels to start a solve from.
  Eigen::VectorXd levels(const Points& vertices) const;

  /// What happens to vertices that were held before, where another one of their group became outermost.
  enum class Former { released, held };
  /// Holds the extent at the bound it passes: in every group the outermost vertex on either side, if it
  /// reaches into the excess. False when that adds nothing to what is held, or, with those before released,
  /// to what was.
  bool hold(std::size_t k, const Points& vertices, Former former);
  /// The constraints that hold what is held.
  std::vector<Constraint> constraints(const MeshTransfer& transfer) const;
  /// Forgets what is held, so that it may be held again.
  void release();

 private:
  /// Of one group on one side of a bound.
  struct Held {
    std::set<int> vertices;  ///< now
    std::set<int> ever;
    double height = 0;  ///< as of Constraint
  };

  bool hold_side(std::size_t k, bool upper, const Points& vertices, Former former);

  const std::vector<std::vector<int>>& groups_;
  std::vector<ExtentBound> bounds_;
  std::map<std::tuple<std::size_t, bool, std::size_t>, Held> held_;  ///< bound, upper side, group
};

}  // namespace stackabilization::detail
