#pragma once

#include <cstddef>

/// Tolerances of primitives, symmetries and project files.
namespace stackabilization::tolerance {

/// Smallest thickness of a cuboid, fraction of its diagonal. Thinner cuboids are thickened to it, because
/// mean value coordinates are undefined in a cage without volume.
inline constexpr double min_thickness = 1e-3;

/// Two symmetries are meant to be the same when they map a part to places nearer than this, fraction of the
/// bounding-box diagonal of the shape. Two planes are meant to meet at a simple angle when they do so within
/// this many radians.
inline constexpr double same_symmetry = 0.01;

/// Axes of symmetries within this angle, in radians, of an axis or a main plane of the file are meant to lie
/// in it. It is fifty times the error of a fit to a mesh with 1e-5 noise, and a tenth of a visible angle.
inline constexpr double file_axis = 1e-3;

/// Accuracy of symmetries of symmetrized primitives, fraction of the diagonal or of the largest coordinate,
/// whichever is larger. It is ten million times smaller than the accuracy promised for edits, and ten times
/// larger than rounding errors.
inline constexpr double symmetrized = 1e-13;

/// Rounding step of the centres and axes of boxes in project files, fraction of a power of two above their
/// largest coordinate. It is 16 times the rounding of the computation, so that writing, reading and writing
/// again gives the same text.
inline constexpr double project_grid = 0x1p-48;

/// Cosine of the angle up to which two directions count as parallel, 8 degrees: axes of symmetries that
/// describe the same thing, of which one was estimated from few samples.
inline constexpr double parallel = 0.99;

/// Cosine of the angle up to which a direction counts as lying in an axis of a box or of a symmetry, 2.6
/// degrees. It is wider than the error of a box fitted to noisy samples.
inline constexpr double aligned = 0.999;

/// Largest height of a triangle that is flat to a line, fraction of the diagonal of its mesh: files have six
/// digits.
inline constexpr double flat_triangle = 1e-5;

/// How far control points of three consecutive parts of a row may be from even steps, fraction of the step.
inline constexpr double row_step = 0.1;
/// The same as a fraction of the diagonal of the shape: a person sees more.
inline constexpr double row_evenness = 0.005;

/// How far consecutive parts of a row may be from one form, fraction of their diagonals: rungs differ less.
inline constexpr double row_form = 0.1;

/// Largest number of parts of a structure that is searched for rows, since all pairs are.
inline constexpr std::size_t max_parts_in_rows = 1'000;

/// Cosine of the angle up to which two normals belong to one flat face, or to faces flush with each other, 14
/// degrees.
inline constexpr double same_face = 0.97;

}  // namespace stackabilization::tolerance
