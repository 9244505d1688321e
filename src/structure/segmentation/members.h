#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "stackabilization/core/shape.h"
#include "stackabilization/structure/fitting.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization::detail {

/// Conditions for cutting a part into members.
struct MemberRule {
  /// Error of the part's own primitive from which on the part may be cut, fraction of the diagonal of its
  /// oriented box. Rings and frames with corners may always be.
  double misfit = 0.03;
  /// Largest error of the primitives of the members together, fraction of that of the part's own primitive.
  double gain = 0.5;
  /// The same for frames with corners, which a curved cylinder follows well.
  double gain_of_frames = 1.25;
  /// Least turn of the curve of a frame with corners, degrees.
  double min_turn = 60;
  /// Least share of the turn in a quarter of the curve: handles bend evenly, frames at their corners.
  double turn_at_corners = 0.75;
  /// Least share of the border of two members across which the surface is concave: a curved backrest is not
  /// cut where it bends evenly.
  double min_concave = 0.1;
  /// Share of the whole border of a member that is little: the flush undersides of two feet beside a column,
  /// for which the feet are not one member.
  double little_border = 0.25;
  /// Least vector area of a piece that is a face of another one, fraction of its area; and least part of it
  /// by which it makes the vector area of the other one smaller. A face is no member.
  double one_sided = 0.9, closes = 0.5;
  int max_members = 16;  ///< a part of more members, such as a lattice, is not cut
  /// Largest diagonal of a part that is not cut since it is small, such as a castor; fraction of that of the
  /// whole shape.
  double small = 0.1;
};

/// Returns whether a part is too small to be cut, against a whole of diagonal `whole` (model units).
bool is_small(const Shape& part, double whole, const MemberRule& rule = {});

/// Returns whether a part may consist of several members: one primitive represents it badly, or has corners,
/// or is closed.
bool may_have_members(const FittedPrimitive& part, const MemberRule& rule = {});

/// Cuts a connected part into pieces: returns a number per triangle, from 0.
using CutIntoPieces = std::function<std::vector<std::int32_t>(const Shape&)>;

/// Returns the member of every triangle of a part, from 0; all zeros for a part that one primitive represents
/// well enough, and where `cut` finds no pieces that are few and represented much better.
std::vector<std::int32_t> members(const Shape& part, const CutIntoPieces& cut, const MemberRule& rule = {});

/// Makes the cuts of parts agree with their symmetries: a part with a reflection of its own is cut alike on
/// both sides, and so are parts that are images of each other. `relations`: those of the parts. Pieces
/// smaller than `smallest`, fraction of the area of the part, join a neighbour.
void make_symmetric(const std::vector<Shape>& parts, const std::vector<Relation>& relations, double smallest,
                    std::vector<std::vector<std::int32_t>>& members);

}  // namespace stackabilization::detail
