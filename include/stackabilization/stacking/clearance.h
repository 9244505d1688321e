#pragma once

#include <cstdint>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/separation.h"

namespace stackabilization {

/// Envelope that a dilated shape must represent. One side has about half of the triangles of both.
enum class DilatedSide { lower, upper, both };

/// Radius and resolution of `dilate_laterally`.
struct DilationOptions {
  double play = 0;                       ///< radius of the disc of lateral shifts, model units, >= 0
  int corners = 16;                      ///< corners of the polygon around the disc, even, in [4, 256]
  DilatedSide side = DilatedSide::both;  ///< envelopes of M + P that the result must have
};

/// A dilated shape and the source of its triangles.
struct DilatedShape {
  Shape shape;  ///< the dilated shape, with the parts of the source
  /// Per triangle of `shape`, a triangle of the source that generates it.
  std::vector<std::int32_t>
      source_triangle;  ///< per triangle of `shape`: one triangle of the source it stems from
};

/// Computes M + P, the Minkowski sum of a shape with a regular polygon P orthogonal to r. P circumscribes the
/// disc of radius `play`, so that M + P contains every lateral shift of M by at most `play`.
///
/// P has `corners` corners and edge midpoints on the frame's u axis (see frame_of). It lies between the disc
/// of radius play and the disc of radius play / cos(pi / corners): at most 2 % more play with the default of
/// 16 corners. The result is a soup whose envelopes along r are those of M + P. Its pieces are triangles at
/// the corners of P, edges swept along the edges of P, and copies of P at the vertices. Pieces that certainly
/// touch no requested envelope are omitted. Constructions in double precision. O(m log m). Throws UsageError
/// for options out of range, and InputError when `validate(shape)` fails.
DilatedShape dilate_laterally(const Shape& shape, const Direction& direction, const DilationOptions& options);

/// Options of `separation_with_play`.
struct PlayOptions {
  double play = 0;                                       ///< largest lateral shift, model units, >= 0
  int corners = 16;                                      ///< see DilationOptions
  ContactSemantics semantics = ContactSemantics::solid;  ///< what counts as a collision
};

/// Computes the smallest t such that `above` + t' r + s is clear of `below` for all t' >= t and all lateral
/// shifts s, |s| <= play: the supremum over s of sep(below, above + s, r).
///
/// The result is never smaller, up to rounding of the dilated coordinates, and never larger than the supremum
/// for play / cos(pi / corners). It is non-decreasing in play. With play 0 it equals separation().
///
/// The witness names triangles of the two given shapes; its upper_point lies on a shifted copy of
/// `upper_triangle`. The shifts give walls of zero thickness a thickness, so such walls count in `solid`
/// semantics too. Throws as `dilate_laterally` does.
Separation separation_with_play(const Shape& below, const Shape& above, const Direction& direction,
                                const PlayOptions& options);

}  // namespace stackabilization
