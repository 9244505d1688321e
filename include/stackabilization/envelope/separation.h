#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/rational.h"
#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Definition of a collision between two shapes.
enum class ContactSemantics {
  /// Interiors intersect. Columns of zero width do not count, so sliding along walls parallel to r is free.
  solid,
  /// Any common point is a collision. Two walls in the same plane block each other. Suitable for sheets of
  /// zero thickness.
  closed,
};

/// Two points that attain a separation: `lower_point` on triangle `lower_triangle` of the upper copy, and
/// `upper_point` on triangle `upper_triangle` of the lower copy. Before the lift, both are on a common line
/// along r. Of triangles with the same three points, the first one is named. The exact separation is the
/// maximum of (a - b).r / r.r over the points a, b of these two triangles on a common line along r, and can
/// be verified in rational arithmetic. The points are the exact ones, rounded to double.
struct Witness {
  std::int32_t upper_triangle = -1;  ///< triangle of the copy below, on its upper envelope
  std::int32_t lower_triangle = -1;  ///< triangle of the copy above, on its lower envelope
  Eigen::Vector3d upper_point = Eigen::Vector3d::Zero();  ///< on `upper_triangle`, file axes, model units
  Eigen::Vector3d lower_point = Eigen::Vector3d::Zero();  ///< on `lower_triangle`, before the lift
};

/// Work of a query, in counts that depend only on the input.
struct SeparationWork {
  std::int64_t node_pairs = 0;      ///< pairs of nodes that were split, or whose triangles were examined
  std::int64_t triangle_pairs = 0;  ///< pairs of triangles bounded in double precision
  std::int64_t exact_pairs = 0;     ///< pairs of triangles decided in rational arithmetic
  std::int64_t longest_queue = 0;   ///< largest number of waiting pairs, in the queue and beside it
};

/// Result of an exact separation query.
struct Separation {
  /// Whether the shapes can collide: the projections along r have a common interior (solid) or a common point
  /// (closed). Otherwise the shapes pass each other at any height, and the other members are meaningless.
  bool blocked = false;
  Rational value;       ///< in units of r: the translation is value * r
  double length = 0;    ///< value * |r|, model units, within 4 ulp
  Witness witness;      ///< points that attain the value
  SeparationWork work;  ///< work of the query
};

/// A certified enclosure of a separation, in units of r: lower <= sep <= upper. Empty (lower = upper = -inf)
/// when not blocked.
struct Enclosure {
  /// Certified lower bound of the separation, units of r.
  double lower = -std::numeric_limits<double>::infinity();
  /// Certified upper bound of the separation, units of r.
  double upper = -std::numeric_limits<double>::infinity();
  /// Whether the query stopped early. Then `lower` > abandon_above and `upper` is +inf.
  bool abandoned = false;
  SeparationWork work;  ///< work of the query
};

/// Options of `separation` and `separation_enclosure`.
struct SeparationOptions {
  ContactSemantics semantics = ContactSemantics::solid;  ///< definition of a collision
  /// Stops as soon as the separation is certainly greater than this, in units of r (enclosure queries only).
  std::optional<double> abandon_above;
  /// Limit of the number of pairs in the queue of the best-first search (32 bytes each). When the queue is
  /// full, further pairs are examined depth first, with no more than some hundred pairs beside the queue. The
  /// value stays the same; of several witnesses, another one may be returned.
  std::int64_t max_queue = std::int64_t{1} << 13;
};

/// Bounding-volume tree of the triangles of a shape. Built once in O(m log m), and queried for any number of
/// directions by any number of threads at the same time. It has its own copy of the coordinates. Triangles
/// with the same three points are one triangle in the tree, with the name of the first one. Two trees are
/// rebuilt for every query between them when one of them lies far from the file's origin (several times its
/// size).
class SeparationTree {
 public:
  /// Precondition: `validate(shape)` passes (InputError otherwise).
  explicit SeparationTree(const Shape& shape);
  SeparationTree(SeparationTree&&) noexcept;
  SeparationTree& operator=(SeparationTree&&) noexcept;
  ~SeparationTree();

  /// Returns the tree of the shape moved by `shift`, model units, each coordinate rounded to double. O(m),
  /// much faster than to build it. Throws UsageError when `shift` is not finite.
  SeparationTree translated(const Eigen::Vector3d& shift) const;

  struct Data;
  /// For the algorithms of this library.
  const Data& data() const { return *data_; }

 private:
  explicit SeparationTree(std::unique_ptr<const Data> data);

  std::unique_ptr<const Data> data_;
};

/// Computes sep(A, B, r): the smallest t such that B + t' r is clear of A for all t' >= t. Exact: a rational
/// number with a witness, for arbitrary triangle soups, in both semantics. It may be negative (B can move
/// down) when A and B are different.
///
/// Branch and bound over pairs of triangles: interval filters decide almost all pairs, rational arithmetic
/// decides the rest. Deterministic. Source: Eq. 1 of the paper, as a maximum over pairs of points on common
/// lines along r.
Separation separation(const SeparationTree& below, const SeparationTree& above, const Direction& direction,
                      const SeparationOptions& options = {});

/// Computes the same quantity as a certified enclosure. Its width is about 1e-12 of the extent along the file
/// axis next to r. Searches over directions use it. Never slower than `separation`.
Enclosure separation_enclosure(const SeparationTree& below, const SeparationTree& above,
                               const Direction& direction, const SeparationOptions& options = {});

/// Computes f_max(M, r) = sep(M, M, r), the minimal stacking translation, for one direction. `blocked` is
/// always true in closed semantics. In solid semantics it is false only when the projection of M along r has
/// no area.
Separation minimal_stacking_translation(const Shape& shape, const Direction& direction,
                                        const SeparationOptions& options = {});

}  // namespace stackabilization
