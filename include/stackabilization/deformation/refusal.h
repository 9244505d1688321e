#pragma once

#include <array>
#include <compare>
#include <limits>
#include <string>

#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Causes for which an edit is refused, with the members of Refusal that tell more. In the order of the
/// sentences in refusal.cpp.
enum class RefusalCause {
  // Models with primitives.
  fixed_part,         ///< `part` is fixed, or symmetric to a part that is
  symmetry_of_shape,  ///< symmetry `relation` contradicts an edit of the whole shape, by `amount`
  symmetry,           ///< symmetry `relation` (none: rounding) contradicts the edit of `part`, by `amount`
  symmetry_of_turn,   ///< the same for a rotation; `amount` in radians
  relation,           ///< `relation` would be violated by `amount`
  primitive_range,    ///< `part` would leave the range of numbers
  inverted_corner,    ///< `part` would be turned inside out at corner `index`
  collapsed_corner,   ///< `part` would collapse at corner `index`
  collapsed_radius,   ///< `part` would lose the radius of cross-section `index`
  collapsed_piece,    ///< `part` would collapse after cross-section `index`
  folded_piece,       ///< `part` would fold after cross-section `index`
  fixed_point,        ///< a fixed point would move by `amount`
  moved_extent,       ///< the extent along `axis` would not lie at its fixed ends, by `amount`
  long_extent,        ///< the extent along `axis` would be too long by `amount`
  short_extent,       ///< the extent along `axis` would be too short by `amount`
  // All models.
  vertex_range,  ///< vertex `index` would leave the range of numbers
  fixed_vertex,  ///< the fixed vertex `index` would move by `amount`
  flat_extent,   ///< the shape would be flattened along the kept extent, which changes by `amount`
  fixed_low,     ///< what is fixed does not let the lower end of the extent move by `amount`
  fixed_high,    ///< the same for the upper end
  box_side,      ///< side `index` (0 to 2: x, y, z) of the box would change by `amount`
  // iWires. All by `amount`.
  wire_junction,   ///< wire `index` would come apart from wire `other`
  wire_plane,      ///< wire `index` would leave the plane of wire `other`
  wire_image,      ///< wire `index` would no longer be the image of wire `other` under a symmetry
  fixed_wire,      ///< wire `index` would leave a fixed point
  wire_extent,     ///< wire `index` would change the kept extent
  collapsed_wire,  ///< wire `index` would shrink to nothing or turn inside out; `amount` is its length
  wire_symmetry,   ///< symmetry `symmetry` would be none; `amount` is a fraction of any length
  wire_image_of,   ///< wire `index` would no longer be the image of wire `other` under symmetry `symmetry`
  // Not of models, but of those who judge the edited design.
  proportions,  ///< `part` would lose its proportions
  unchanged,    ///< nothing would change
  undefined,    ///< stackability or distortion would be undefined
  // Models without primitives.
  collapsed_triangle,  ///< triangle `index` would lose a side
  // Models with primitives. New causes come last: saved searches hold their numbers.
  uneven_row,  ///< the row around `part` would no longer have even steps, by `amount`
};

/// Why an edit was refused. The cause says which of the other members are set.
struct Refusal {
  /// Stands for numbers that a cause does not have, or that are not told.
  static constexpr double untold = -std::numeric_limits<double>::infinity();

  RefusalCause cause = RefusalCause::undefined;           ///< requirement that would be violated
  int part = -1;                                          ///< row of Structure::parts
  int relation = -1;                                      ///< row of Structure::relations
  int index = -1, other = -1;                             ///< see RefusalCause
  int symmetry = -1;                                      ///< row of WireStructure::symmetries
  std::array<double, 3> axis = {untold, untold, untold};  ///< unit direction of an extent
  /// Size of the violation, fraction of the bounding-box diagonal of the shape at rest unless the cause names
  /// another unit.
  double amount = untold;

  /// Compares the members in their order.
  auto operator<=>(const Refusal&) const = default;
};

/// Returns the refusal as it is counted with others of its kind: without its amount, and without the
/// components of its axis but 0 and, to three digits, 1 and -1. A search that turns its direction from design
/// to design meets the same refusal along directions that differ a little.
Refusal without_amounts(Refusal refusal);

/// Returns the refusal as one sentence without a full stop: which requirement would be violated, and by how
/// much if its amount is told. "..." stands for components of an axis that are not told. `structure`: that of
/// the shape at rest; only the names of its parts and relations are used. Throws std::out_of_range when it
/// has no such part or relation.
std::string describe(const Refusal& refusal, const Structure& structure);

}  // namespace stackabilization
