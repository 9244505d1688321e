#pragma once

#include <cstdint>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/separation.h"

namespace stackabilization {

/// Which envelope of a dilated shape is wanted; one side has about half the triangles of both.
enum class DilatedSide { lower, upper, both };

/// How far and how finely `dilate_laterally` dilates.
struct DilationOptions {
  double play = 0;                       ///< radius of the disc of lateral shifts, model units, >= 0
  int corners = 16;                      ///< corners of the polygon around that disc, even, in [4, 256]
  DilatedSide side = DilatedSide::both;  ///< envelopes that the result must get right
};

/// A dilated shape and where its triangles come from.
struct DilatedShape {
  Shape shape;  ///< parts as in the source
  std::vector<std::int32_t>
      source_triangle;  ///< per triangle of `shape`: one triangle of the source it stems from
};

/// M + P, the Minkowski sum of a shape with a regular polygon P orthogonal to r that circumscribes the disc
/// of radius `play`: every lateral shift of M by at most `play`, at once.
///
/// P has `corners` corners, edge midpoints on the frame's u axis (see frame_of), and lies between the disc
/// and the disc of radius play / cos(pi / corners): 2 % more play at most with the default 16 corners. The
/// result is a soup whose envelopes along r are those of M + P; of the pieces of the sum (triangles at the
/// corners of P, edges swept along the edges of P, P at the vertices) those that certainly touch no wanted
/// envelope are left out. Constructions in double precision. O(m log m). Throws UsageError on options outside
/// their ranges, InputError when `validate(shape)` fails.
DilatedShape dilate_laterally(const Shape& shape, const Direction& direction, const DilationOptions& options);

/// Play that `separation_with_play` leaves.
struct PlayOptions {
  double play = 0;                                       ///< largest lateral shift, model units, >= 0
  int corners = 16;                                      ///< as in DilationOptions
  ContactSemantics semantics = ContactSemantics::solid;  ///< what counts as a collision
};

/// The least t such that `above` + t' r + s is clear of `below` for all t' >= t and every lateral shift s,
/// |s| <= play: sup over s of sep(below, above + s, r), never less (up to rounding of the dilated
/// coordinates), and never more than the same with play / cos(pi / corners). Non-decreasing in play. With
/// play 0 it is separation().
///
/// The witness names triangles of the two given shapes; its upper_point lies on a shifted copy of
/// `upper_triangle`. Walls of no thickness gain thickness by the shifts and so count in `solid` semantics
/// too.
Separation separation_with_play(const Shape& below, const Shape& above, const Direction& direction,
                                const PlayOptions& options);

}  // namespace stackabilization
