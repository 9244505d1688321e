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

/// What counts as a collision between two shapes.
enum class ContactSemantics {
  solid,   ///< interiors meet: columns of zero width do not count, so sliding along walls parallel to r is
           ///< free
  closed,  ///< any common point: two walls in the same plane block each other; right for zero-thickness
           ///< sheets
};

/// Where a separation is attained: `lower_point` lies on triangle `lower_triangle` of the upper copy,
/// `upper_point` on triangle `upper_triangle` of the lower copy, straight above each other along r before the
/// lift. Of triangles with the same three points the first is named. The exact value is the maximum of (a -
/// b).r / r.r over the points a, b of these two triangles on a common line along r, which anyone can
/// recompute in rational arithmetic; the points are the exact ones rounded to double.
struct Witness {
  std::int32_t upper_triangle = -1;  ///< triangle of the copy below, on its upper envelope
  std::int32_t lower_triangle = -1;  ///< triangle of the copy above, on its lower envelope
  Eigen::Vector3d upper_point = Eigen::Vector3d::Zero();  ///< on `upper_triangle`, file axes, model units
  Eigen::Vector3d lower_point = Eigen::Vector3d::Zero();  ///< on `lower_triangle`, before the lift
};

/// What a query did, in counts that depend on the input alone.
struct SeparationWork {
  std::int64_t node_pairs = 0;      ///< pairs of nodes that were split, or whose triangles were looked at
  std::int64_t triangle_pairs = 0;  ///< pairs of triangles bounded in double precision
  std::int64_t exact_pairs = 0;     ///< pairs of triangles decided in rational arithmetic
  std::int64_t longest_queue = 0;   ///< most pairs that waited at a time, in the queue and beside it
};

/// Result of an exact separation query.
struct Separation {
  /// False when the projections along r have no common interior (solid) or no common point (closed): the
  /// shapes pass each other at any height, and the other fields are meaningless.
  bool blocked = false;
  Rational value;       ///< in units of r: the translation is value * r
  double length = 0;    ///< value * |r|, model units, within 4 ulp
  Witness witness;      ///< where the value is attained
  SeparationWork work;  ///< what it took
};

/// A certified enclosure of a separation, in units of r: lower <= sep <= upper. Empty (lower = upper = -inf)
/// when not blocked.
struct Enclosure {
  double lower = -std::numeric_limits<double>::infinity();  ///< certainly at most sep, units of r
  double upper = -std::numeric_limits<double>::infinity();  ///< certainly at least sep, units of r
  bool abandoned = false;  ///< stopped early: only `lower` > abandon_above is known, upper is +inf
  SeparationWork work;     ///< what it took
};

/// Options of `separation` and `separation_enclosure`.
struct SeparationOptions {
  ContactSemantics semantics = ContactSemantics::solid;  ///< what counts as a collision
  /// Stop as soon as the separation is certainly greater than this many units of r (enclosure queries only).
  std::optional<double> abandon_above;
  /// Most pairs that wait in the queue of the best-first search (of 32 bytes each). Once it is full, further
  /// pairs are followed depth first: no more than some hundred wait beside it, and the value is the same, of
  /// several witnesses perhaps another.
  std::int64_t max_queue = std::int64_t{1} << 20;
};

/// Bounding-volume tree of a shape's triangles, built once and queried for any number of directions, by any
/// number of threads at the same time. It keeps its own copy of the coordinates. O(m log m) to build.
/// Triangles with the same three points are one in it, named by the first of them.
/// Two trees of which one lies far from the file's origin (several times its size) are built again for every
/// query between them.
class SeparationTree {
 public:
  /// Precondition: `validate(shape)` passes (InputError otherwise).
  explicit SeparationTree(const Shape& shape);
  SeparationTree(SeparationTree&&) noexcept;
  SeparationTree& operator=(SeparationTree&&) noexcept;
  ~SeparationTree();

  struct Data;
  /// For the algorithms of this library: see envelope/separation_tree.h.
  const Data& data() const { return *data_; }

 private:
  std::unique_ptr<const Data> data_;
};

/// sep(A, B, r): the least t such that B + t' r is clear of A for all t' >= t. Exact: a rational number with
/// a witness, for any triangle soups, in both semantics. May be negative (B can move down) when A and B are
/// different.
///
/// Branch and bound over pairs of triangles; interval filters decide almost everything, rational arithmetic
/// the rest. Deterministic. Source: Eq. 1 of the paper, read as a maximum over pairs of points on common
/// lines along r.
Separation separation(const SeparationTree& below, const SeparationTree& above, const Direction& direction,
                      const SeparationOptions& options = {});

/// Same quantity as a certified enclosure, about 1e-12 of the extent along the file axis next to r wide: what
/// searches over directions use. Never slower than `separation`.
Enclosure separation_enclosure(const SeparationTree& below, const SeparationTree& above,
                               const Direction& direction, const SeparationOptions& options = {});

/// f_max(M, r) = sep(M, M, r), the minimal stacking translation, for one use. `blocked` is always true in
/// closed semantics; in solid semantics it is false only when the projection of M along r has no area.
Separation minimal_stacking_translation(const Shape& shape, const Direction& direction,
                                        const SeparationOptions& options = {});

}  // namespace stackabilization
