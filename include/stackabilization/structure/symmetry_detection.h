#pragma once

#include <vector>

#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Which symmetries `find_symmetries` looks for.
struct SymmetryOptions {
  /// Largest root mean square distance between the surface and its image, in (0, 1), as a fraction of the
  /// diagonal of the minimal oriented box; for slender shapes, of three times the middle extent of that box.
  double tolerance = 0.01;
  /// Share of the surface area, in (0, 1], that must have a counterpart; the rest may be missing detail.
  /// Detail stands out by at most 0.4 (1 - `support`) of the diagonal: a missing leg is no detail, however
  /// thin.
  double support = 0.9;
};

/// A symmetry of a shape, and how well the shape has it.
struct FoundSymmetry {
  Symmetry symmetry;  ///< model units, file axes
  /// Root mean square distance of the best `SymmetryOptions::support` of the area to its image, fraction of
  /// the diagonal of the minimal box.
  double residual = 0;
  double support = 0;  ///< share of the area that has a counterpart within three times the tolerance
};

/// Global symmetries of a shape by voting (Mitra, Guibas and Pauly 2006): pairs of surface samples that see
/// the same shape around them vote for the reflection, or for the axis of rotation, that takes one to the
/// other; the axes of the minimal box and of the second moments are candidates as well. Candidates are
/// refined and verified on the surface itself.
///
/// In this order: reflections across an axis of the minimal box, longest extent first; other reflections,
/// best first; rotations, of the highest order about each axis, highest order first; revolutions. Round
/// shapes (regular prisms of 14 sides and more, cups) have their revolution and at most the reflection across
/// it instead of a heap of planes through the axis; a sphere has three of both.
///
/// Guarantee: deterministic, the same bytes for any number of threads. Decisions do not depend on pose and
/// size. Where the surface is symmetric up to missing detail, planes and axes are right to rounding (1e-9 of
/// the diagonal); else they are a robust least-squares fit. Throws InputError when `validate(shape)` does or
/// no triangle has an area, UsageError for options out of range.
std::vector<FoundSymmetry> find_symmetries(const Shape& shape, const SymmetryOptions& options = {});

/// What symmetries of the whole mean for its parts: which parts a reflection takes onto themselves
/// (self_symmetry) and which onto another (symmetry). Pairs come first, then self-symmetries, each in the
/// order of the parts.
///
/// * Reflections: at most three, mutually orthogonal, exactly so in the result; planes along the boxes of
///   the parts and of the whole go before diagonals, so that four legs are a cycle of four pairs. A plane at
///   another angle counts only when it gives a part its first counterpart (three legs, five legs) or, except
///   at 45 degrees, makes parts equal that nothing else does (six legs), and is turned by what makes it
///   generate a finite group with the others. Of a revolution two perpendicular planes through the axis
///   count.
/// * A part has a counterpart, or is its own, when the image comes within the tolerance of it, by the
///   distance of centroids and by the root mean square distance of the surfaces both ways, as fractions of
///   the whole shape, and when in addition their sizes agree to ten tolerances.
/// * A part of revolution that has no counterpart and that no reflection mirrors end to end has two
///   self-symmetries with perpendicular planes through its axis, those of the whole first, and its
///   revolution (`SymmetryKind::revolution`).
/// * Other parts that no symmetry of the whole bears on get the planes through their own middle, along
///   their own box, that they are symmetric about.
///
/// Of `symmetries` (model units, in any order; a user may have edited them) rotations are not looked at.
/// Residuals are root mean square distances of the surfaces. Throws as `find_symmetries` does.
std::vector<Relation> symmetry_relations(const Shape& shape, const std::vector<FoundSymmetry>& symmetries,
                                         const SymmetryOptions& options = {});

}  // namespace stackabilization
