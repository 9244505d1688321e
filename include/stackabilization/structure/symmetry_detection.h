#pragma once

#include <vector>

#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Tolerances of `find_symmetries`.
struct SymmetryOptions {
  /// Largest root mean square distance between the surface and its image, in (0, 1). It is a fraction of the
  /// diagonal of the minimal oriented box; for slender shapes, a fraction of three times the middle extent of
  /// that box.
  double tolerance = 0.01;
  /// Share of the surface area, in (0, 1], that must have a counterpart. The rest may be missing detail.
  /// Detail deviates by at most 0.4 (1 - `support`) of the diagonal: a missing leg is not detail, however
  /// thin it is.
  double support = 0.9;
};

/// A symmetry of a shape with its residual.
struct FoundSymmetry {
  Symmetry symmetry;  ///< model units, file axes
  /// Root mean square distance between the best `SymmetryOptions::support` of the area and its image,
  /// fraction of the diagonal of the minimal box.
  double residual = 0;
  /// Share of the area that has a counterpart within three times the tolerance.
  double support = 0;
};

/// Finds the symmetries of a whole shape by voting (Mitra, Guibas and Pauly 2006). Pairs of surface samples
/// with similar neighbourhoods vote for the reflection, or for the rotation axis, that maps one sample to the
/// other. The axes of the minimal box and of the second moments are further candidates. The function refines
/// the candidates and verifies them on the surface.
///
/// The order is: reflections across an axis of the minimal box, longest extent first; other reflections,
/// smallest residual first; rotations, with the highest order about each axis, highest order first;
/// revolutions. A round shape (a regular prism of 14 sides and more, a cup) has its revolution and at most
/// the reflection across its axis, not the many planes through the axis. A sphere has three revolutions and
/// three reflections.
///
/// Guarantee: deterministic, the same bytes for any number of threads. Decisions are independent of pose and
/// size. Where the surface is symmetric up to missing detail, planes and axes are accurate to rounding (1e-9
/// of the diagonal). Elsewhere they are a robust least-squares fit. Throws InputError when `validate(shape)`
/// fails or no triangle has an area, and UsageError for options out of range.
std::vector<FoundSymmetry> find_symmetries(const Shape& shape, const SymmetryOptions& options = {});

/// Derives the symmetry relations of the parts from the symmetries of the whole shape. A reflection maps a
/// part to itself (self_symmetry) or to another part (symmetry). Symmetric pairs come first, then
/// self-symmetries, each in the order of the parts.
///
/// * Reflections: the function takes at most three, and makes them exactly orthogonal to each other. Planes
///   along the boxes of the parts and of the whole shape precede diagonal planes, so that four legs form a
///   cycle of four pairs. It takes a plane at another angle in two cases: when the plane gives a part its
///   first counterpart (three legs, five legs), or when it alone makes parts equal (six legs) and its angle
///   is not 45 degrees. It rotates such a plane so that the plane generates a finite group with the others.
///   Of a revolution, it takes two perpendicular planes through the axis. Of four planes at 45 degrees it
///   takes the two others where these make equal all that the first two do, and more.
/// * It takes a rotation whose axis lies in none of these planes where the rotation moves parts in cycles
/// that
///   no plane makes equal (three skewed legs). A relation leads from each part of a cycle to the next, but
///   for the last.
/// * A part has a counterpart, or is its own counterpart, when the image of the part matches within the
///   tolerance. The match compares the distance of the centroids and the root mean square distance of the
///   surfaces in both directions, as fractions of the whole shape, and the sizes of the parts (root mean
///   square widths, or the sides of their minimal boxes where one of them lacks faces) within ten tolerances.
///   Two parts without such a match, whose ends may be cut off differently, are counterparts as well when
///   nine tenths of the image of each lie on the other to a tenth of the tolerance, and all of it on the
///   shape. Parts without such a counterpart are counterparts, or their own, when they match at twice the
///   tolerance of distances.
/// * A part of revolution without a counterpart, whose ends no reflection exchanges, has two self-symmetries
///   with perpendicular planes through its axis, those of the whole shape first, and its revolution
///   (`SymmetryKind::revolution`).
/// * Any other part of a shape without a reflection gets its own reflections in planes through its centre and
///   along its box.
///
/// `symmetries`: model units, any order; a user may have edited them. Residuals are
/// root mean square distances of the surfaces. Throws as `find_symmetries` does.
std::vector<Relation> symmetry_relations(const Shape& shape, const std::vector<FoundSymmetry>& symmetries,
                                         const SymmetryOptions& options = {});

}  // namespace stackabilization
